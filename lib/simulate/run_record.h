// What a run leaves while it is made.
//
// Steps are added to the open flow; flow_ends() closes it as one FlowPiece. Notes are limited to
// kInARow, jumps and numbers by RecordLimits.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hybrid/system.h"
#include "hybrid/trajectory.h"

namespace gainsmith::simulate {

/// Jumps and numbers that a run keeps, at most: one more ends it.
struct RecordLimits {
  std::int64_t jumps = 10'000'000;
  std::size_t numbers = 250'000'000;  ///< 2 GB
};

class RunRecord {
 public:
  /// The system must outlive it.
  RunRecord(const hybrid::System& system, double horizon, const RecordLimits& limits = {});

  void start(const Eigen::VectorXd& variables) { result_.start = variables; }

  /// A flow begins, or goes on with another branch.
  void flow_begins(std::int64_t j, const Eigen::VectorXd& variables);
  /// RunEnd when the record is full.
  void add(const hybrid::DenseStep& step, const Eigen::VectorXd& end);
  /// The flow that is open; without steps none is.
  const hybrid::FlowPiece& flow() const { return piece_; }
  /// Closes the open flow; nothing where no step was added.
  void flow_ends();
  /// Where the flow that is open ended is known better.
  void ended_at(const Eigen::VectorXd& end) { end_ = end; }

  /// RunEnd when the record is full.
  void add(hybrid::JumpPoint jump);
  /// Of a chain of jumps without a flow between them.
  static constexpr std::size_t kept_of_chain = 1000;
  /// Leaves out the last `count` jumps but for the first of them.
  void shorten_chain(std::int64_t count);
  /// "a, b": the events of the last hundred jumps, each once.
  std::string last_events() const;

  void note(const std::string& text);
  void add(const hybrid::NearTurn& turn) { result_.turns.push_back(turn); }
  void accumulates(double t) { result_.accumulation = t; }

  /// The solution up to `end`; the record is empty afterwards.
  hybrid::Trajectory take(double end);
  /// With its cause; `why` is without time and place of the run.
  void ends(hybrid::Ending ending, const std::string& why, double t, std::int64_t j);

 private:
  void keep(std::size_t numbers);
  [[noreturn]] void is_full(const std::string& of) const;

  const hybrid::System* system_;
  RecordLimits limits_;
  std::vector<std::int64_t> jumps_;  ///< by event
  std::int64_t all_jumps_ = 0;
  std::size_t numbers_ = 0;
  Eigen::VectorXd end_;  ///< the variables where the flow ended last
  hybrid::FlowPiece piece_;
  hybrid::Trajectory result_;
};

}  // namespace gainsmith::simulate
