// SPDX-License-Identifier: GPL-3.0-or-later
/// A study on many machines: processes started together by mpirun, of which the first hands out the points.
#pragma once

#include <memory>

#include "earthtop/study/study.hpp"
#include "earthtop/watch.hpp"

namespace earthtop {

/// Whether this program was built with MPI.
bool has_mpi();

/// How many processes a launcher started this one with; 1 without a launcher.
unsigned launched_processes();

/// This process among those it was started with. Without MPI, or started alone: the first and only one.
class StudyProcesses {
 public:
  /// @throws ScenarioError where a launcher started several processes of a program that was built without MPI
  StudyProcesses();
  /// Sends the others home.
  ~StudyProcesses();
  StudyProcesses(const StudyProcesses&) = delete;
  StudyProcesses& operator=(const StudyProcesses&) = delete;

  bool is_first() const;
  unsigned workers() const;  ///< processes beside the first
  /// Of one that is not the first: computes what it is given until it is sent home.
  /// @param watch  may stop the runs
  void serve(const Watch& watch = {});

  struct Session;
  Session& session() { return *session_; }

 private:
  std::unique_ptr<Session> session_;
};

}  // namespace earthtop
