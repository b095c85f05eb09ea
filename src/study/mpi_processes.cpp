// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that communicate through MPI. The first one hands out work and collects results; the others wait for work, compute
// it, and send the results back.
#include <mpi.h>

#include <deque>
#include <exception>
#include <optional>
#include <thread>

#include "earthtop/run.hpp"
#include "study/message.hpp"
#include "study/process_workforce.hpp"

namespace earthtop {

namespace {

enum Tag : int { kStudyText, kChunk, kResults, kStop };

/// The exit status of a program that was told to stop: 128 + SIGTERM.
constexpr int kStopped = 143;

/// A received message.
struct Message {
  int from, tag;
  std::string bytes;
};
std::optional<Message> next_message() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.from, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

/// Returns when the message may be considered sent, which can take until it is received: for workers only, whose messages the
/// first process always receives.
void send(int to, Tag tag, const std::string& bytes) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

/// Messages that the first process sends. It does not wait until they are received: both sides would wait for ever if the
/// worker waited, too, for its own message to be received.
class Outbox {
 public:
  void send(int to, Tag tag, std::string bytes) {
    while (!letters_.empty() && is_taken(letters_.front())) letters_.pop_front();
    Letter& letter = letters_.emplace_back(Letter{std::move(bytes), MPI_REQUEST_NULL});
    MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &letter.request);
  }
  void wait() {
    for (Letter& letter : letters_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
    letters_.clear();
  }

 private:
  struct Letter {
    std::string bytes;
    MPI_Request request;
  };
  static bool is_taken(Letter& letter) {
    int taken = 0;
    MPI_Test(&letter.request, &taken, MPI_STATUS_IGNORE);
    return taken != 0;
  }
  std::deque<Letter> letters_;
};

/// Sleeps between two looks for messages, so that waiting does not occupy a core on which another process could compute.
void nap() { std::this_thread::sleep_for(std::chrono::microseconds(500)); }

std::string study_message(const Study& study) {
  study::MessageWriter writer;
  for (const std::string* text : {&study.name, &study.text, &study.base.file, &study.base.text})
    writer.put(std::string_view(*text));
  return writer.bytes();
}
Study study_from(std::string_view bytes) {
  study::MessageReader reader(bytes);
  const std::string name = reader.text(), text = reader.text(), file = reader.text(), base = reader.text();
  Study study = parse_study({name + ".json", text}, ScenarioSource{file, base});
  study.name = name;
  return study;
}

}  // namespace

bool has_mpi() { return true; }

struct StudyProcesses::Session {
  int rank = 0, size = 1;
  bool initialized = false;
  Outbox outbox;              ///< used by the first process
  std::size_t under_way = 0;  ///< chunks given to the others and not yet answered
  bool is_given_up = false;   ///< a worker did not answer when all were asked to stop
};

StudyProcesses::StudyProcesses() : session_(std::make_unique<Session>()) {
  if (launched_processes() < 2) return;
  MPI_Init(nullptr, nullptr);
  session_->initialized = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &session_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &session_->size);
}

StudyProcesses::~StudyProcesses() {
  if (!session_->initialized) return;
  if (!is_first() && std::uncaught_exceptions() > 0) MPI_Abort(MPI_COMM_WORLD, 1);  // the other processes would wait for ever
  if (session_->is_given_up) MPI_Abort(MPI_COMM_WORLD, kStopped);
  if (is_first()) {
    while (session_->under_way > 0)  // after an error: receive what workers are still sending
      if (const auto message = next_message(); message && message->tag == kResults) --session_->under_way;
    for (int worker = 1; worker < session_->size; ++worker) session_->outbox.send(worker, kStop, "");
    session_->outbox.wait();
  }
  MPI_Finalize();
}

bool StudyProcesses::is_first() const { return session_->rank == 0; }

unsigned StudyProcesses::workers() const { return static_cast<unsigned>(session_->size - 1); }

void StudyProcesses::serve(const Watch& watch) {
  std::optional<Study> study;
  std::optional<study::Collector> collector;
  for (;;) {
    const auto message = next_message();
    if (!message) {
      nap();
    } else if (message->tag == kStop) {
      return;
    } else if (message->tag == kStudyText) {
      study = study_from(message->bytes);
      collector.emplace(*study);
    } else if (message->tag == kChunk && collector) {
      send(0, kResults, to_message(study::compute(*study, *collector, study::chunk_from(message->bytes), watch)));
    }
  }
}

namespace study {
namespace {

class Processes : public Workforce {
 public:
  Processes(const Study& study, StudyProcesses& processes, const Watch& watch)
      : session_(processes.session()), watch_(watch), in_hand_(processes.workers() + 1) {
    for (std::size_t worker = 1; worker < in_hand_.size(); ++worker)
      session_.outbox.send(static_cast<int>(worker), kStudyText, study_message(study));
  }

  bool wants_work() override { return least_busy() != 0; }
  void give(Chunk chunk) override {
    const unsigned worker = least_busy();
    session_.outbox.send(static_cast<int>(worker), kChunk, to_message(chunk));
    ++in_hand_[worker];
    ++session_.under_way;
  }
  std::size_t under_way() const override { return session_.under_way; }
  std::vector<PointResult> collect(std::chrono::milliseconds patience) override {
    std::vector<PointResult> results;
    const auto until = std::chrono::steady_clock::now() + patience;
    do {
      while (const auto message = next_message()) {
        if (message->tag != kResults) continue;
        --in_hand_[static_cast<std::size_t>(message->from)];
        --session_.under_way;
        auto points = results_from(message->bytes);
        results.insert(results.end(), std::make_move_iterator(points.begin()), std::make_move_iterator(points.end()));
        if (points.empty()) return results;  // the worker was interrupted: no more will come
      }
      if (results.empty() && session_.under_way > 0) nap();
    } while (results.empty() && session_.under_way > 0 && std::chrono::steady_clock::now() < until);
    if (watch_.asks_to_stop()) give_up_silent_workers();
    return results;
  }

 private:
  /// The worker with the fewest chunks, if it has at most one; 0 if all have two.
  unsigned least_busy() const {
    unsigned best = 0;
    for (unsigned worker = 1; worker < in_hand_.size(); ++worker)
      if (in_hand_[worker] < 2 && (best == 0 || in_hand_[worker] < in_hand_[best])) best = worker;
    return best;
  }

  /// When one process is lost, the launcher tells the others to stop, and kills them a second later. Results of the lost one
  /// will never come; what came from the others is to be stored, and the user told how to go on, within that second.
  void give_up_silent_workers() {
    constexpr auto kPatience = std::chrono::milliseconds(400);
    const auto now = std::chrono::steady_clock::now();
    if (!asked_to_stop_) asked_to_stop_ = now;
    if (session_.under_way == 0 || now - *asked_to_stop_ < kPatience) return;
    session_.under_way = 0;
    session_.is_given_up = true;
  }

  StudyProcesses::Session& session_;
  Watch watch_;
  std::optional<std::chrono::steady_clock::time_point> asked_to_stop_;
  std::vector<int> in_hand_;  // number of chunks that each process has; process 0 computes none
};

}  // namespace

std::unique_ptr<Workforce> make_processes(const Study& study, StudyProcesses& processes, const Watch& watch) {
  return std::make_unique<Processes>(study, processes, watch);
}

}  // namespace study
}  // namespace earthtop
