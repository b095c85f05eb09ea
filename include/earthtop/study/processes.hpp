// SPDX-License-Identifier: GPL-3.0-or-later
/// A study computed by many processes, possibly on many machines. mpirun starts them together; the first one hands out the
/// points.
#pragma once

#include <memory>

#include "earthtop/study/study.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// Whether this program was built with MPI.
bool has_mpi();

/// How many processes a launcher started this one with; 1 without a launcher.
unsigned launched_processes();

/// The set of processes that a launcher started together, seen from one of them. Without MPI, or when started alone, the only
/// process is the first one.
class StudyProcesses {
 public:
  /// @throws ScenarioError if a launcher started several processes but this program was built without MPI
  StudyProcesses();
  /// In the first process: tells all others to leave `serve`.
  ~StudyProcesses();
  StudyProcesses(const StudyProcesses&) = delete;
  StudyProcesses& operator=(const StudyProcesses&) = delete;

  bool is_first() const;
  unsigned workers() const;  ///< number of processes besides the first
  /// Computes the points that the first process sends, until the first process ends. To be called in every process but the
  /// first.
  /// @param watch may stop the runs
  void serve(const Watch& watch = {});

  struct Session;
  Session& session() { return *session_; }

 private:
  std::unique_ptr<Session> session_;
};

}  // namespace earthtop
