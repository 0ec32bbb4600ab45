#include "handway/planning/campaigns/run_workers.h"

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/status.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

/// Serialization of runs for the transfer between processes.
namespace boost::serialization {

template <typename Archive>
void serialize(Archive& archive, handway::planning::RunSpec& spec, unsigned /*version*/) {
  archive& spec.problem& spec.planner& spec.seed;
}

template <typename Archive>
void serialize(Archive& archive, handway::planning::PathMeasures& measures, unsigned /*version*/) {
  archive& measures.to_subspace& measures.hand_sparc& measures.palm_sparc& measures.arm_deviation;
}

template <typename Archive>
void serialize(Archive& archive, handway::planning::RunRecord& run, unsigned /*version*/) {
  archive& run.spec& run.solved& run.status& run.reason;
  archive& run.time_s& run.smoothing_s& run.sampling_s& run.connection_s;
  archive& run.samples& run.nodes& run.edges& run.passes& run.max_trials& run.final_rho_a;
  archive& run.nodes_per_pmds& run.node_checks& run.edge_checks& run.edges_tested;
  archive& run.path_nodes& run.path_length& run.resolution& run.min_clearance;
  archive& run.certificate_checks& run.path;
  archive& run.cpu_s& run.l2_length& run.is_checked& run.fault& run.measures;
}

}  // namespace boost::serialization

namespace handway::campaign_mpi {
namespace {

namespace mpi = boost::mpi;
using planning::RunExecutor;
using planning::RunRecord;
using planning::RunSpec;

constexpr int kLeader = 0;
constexpr std::chrono::microseconds kPause(200);  // between looks at the mail

// Messages of the leader.
enum LeaderTag : int {
  kRun = 1,     ///< RunSpec: carry it out.
  kRest = 2,    ///< Empty: all is done, return from serve().
  kGoHome = 3,  ///< Empty: the leader has given up.
};
// Messages of the workers.
enum WorkerTag : int {
  kReady = 11,    ///< Empty: ready for a run.
  kRecord = 12,   ///< RunRecord.
  kDropped = 13,  ///< Empty: the run was cancelled.
  kFailed = 14,   ///< std::string: the reason why it can't continue.
};

/// The leader's own worker: a thread that receives runs one by one.
class OwnWorker {
 public:
  OwnWorker(const RunExecutor& executor, std::stop_token stop)
      : executor_(executor),
        stop_(std::move(stop)),
        thread_([this](const std::stop_token& end) { work(end); }) {}

  void give(const RunSpec& spec) {
    const std::lock_guard lock(mutex_);
    given_.push_back(spec);
    changed_.notify_one();
  }

  struct Answer {
    std::optional<RunRecord> record;
    std::exception_ptr failure;
  };
  /// Returns the result of a run, if one has ended.
  std::optional<Answer> collect() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }

 private:
  void work(const std::stop_token& end) {
    while (true) {
      RunSpec spec;
      {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, end, [&] { return !given_.empty(); })) {
          return;
        }
        spec = given_.front();
        given_.pop_front();
      }
      Answer answer;
      try {
        answer.record = executor_.run(spec, stop_);
      } catch (...) {
        answer.failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      answer_ = std::move(answer);
    }
  }

  const RunExecutor& executor_;
  std::stop_token stop_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<RunSpec> given_;
  std::optional<Answer> answer_;
  std::jthread thread_;
};

/// Deals out runs and counts the busy processes.
class Dealer {
 public:
  Dealer(mpi::communicator& world, OwnWorker& own, std::span<const RunSpec> runs)
      : world_(world), own_(own), runs_(runs) {}

  [[nodiscard]] bool done() const { return busy_ == 0 && (next_ == runs_.size() || stopped_); }
  void stop() { stopped_ = true; }
  void deal_to_self() {
    if (more()) {
      own_.give(runs_[next_++]);
      ++busy_;
    }
  }
  /// Reads all pending messages. @returns whether there were any.
  bool read_mail(std::vector<RunRecord>& records);
  bool collect_own(std::vector<RunRecord>& records);

 private:
  [[nodiscard]] bool more() const { return next_ < runs_.size() && !stopped_; }
  void deal_to(int rank) {
    if (more()) {
      world_.send(rank, kRun, runs_[next_++]);
      ++busy_;
    }
  }

  mpi::communicator& world_;
  OwnWorker& own_;
  std::span<const RunSpec> runs_;
  std::size_t next_ = 0;
  int busy_ = 0;  ///< Runs without an answer yet.
  bool stopped_ = false;
};

bool Dealer::read_mail(std::vector<RunRecord>& records) {
  bool some = false;
  while (const boost::optional<mpi::status> mail = world_.iprobe(mpi::any_source, mpi::any_tag)) {
    some = true;
    const int rank = mail->source();
    if (mail->tag() == kFailed) {
      std::string reason;
      world_.recv(rank, kFailed, reason);
      throw std::runtime_error(reason);
    }
    if (mail->tag() == kRecord) {
      world_.recv(rank, kRecord, records.emplace_back());
      --busy_;
    } else {
      world_.recv(rank, mail->tag());
      busy_ -= mail->tag() == kDropped ? 1 : 0;
    }
    deal_to(rank);
  }
  return some;
}

bool Dealer::collect_own(std::vector<RunRecord>& records) {
  std::optional<OwnWorker::Answer> answer = own_.collect();
  if (!answer) {
    return false;
  }
  --busy_;
  if (answer->failure) {
    std::rethrow_exception(answer->failure);
  }
  if (answer->record) {
    records.push_back(std::move(*answer->record));
  }
  deal_to_self();
  return true;
}

}  // namespace

/// The processes of one `mpirun`, a run at a time on each. Rank 0 leads: it deals out runs one by
/// one to idle processes, itself included (on a second thread), and collects the records. No
/// process waits busily.
///
/// One for each process, made before any other use of MPI.
class MpiTeam final : public planning::ProcessTeam {
 public:
  MpiTeam();
  /// The leader makes the others return from serve().
  ~MpiTeam() override;
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  [[nodiscard]] int count() const override { return world_.size(); }
  [[nodiscard]] bool leads() const override { return world_.rank() == 0; }
  void carry_out(const planning::RunExecutor& executor, std::span<const planning::RunSpec> runs,
                 const planning::TakeRecords& take, std::stop_token stop) override;
  /// @throws std::runtime_error if the leader gave up.
  void serve(const planning::RunExecutor& executor) override;
  void decline(const std::string& reason) override;

 private:
  boost::mpi::environment environment_;
  boost::mpi::communicator world_;
};

MpiTeam::MpiTeam() : environment_(mpi::threading::funneled, false) {}

MpiTeam::~MpiTeam() {
  try {
    const bool has_team = world_.rank() == 0;
    for (int rank = 1; has_team && rank < world_.size(); ++rank) {
      world_.send(rank, kGoHome);
    }
  } catch (const std::exception&) {  // they are gone already
    environment_.abort(1);
  }
}

void MpiTeam::carry_out(const RunExecutor& executor, std::span<const RunSpec> runs,
                        const planning::TakeRecords& take, std::stop_token stop) {
  constexpr std::chrono::milliseconds kTakePause(200);
  std::stop_source end;
  const std::stop_callback forward(stop, [&] { end.request_stop(); });
  OwnWorker own(executor, end.get_token());
  try {
    Dealer dealer(world_, own, runs);
    dealer.deal_to_self();
    std::vector<RunRecord> records;
    auto next_take = std::chrono::steady_clock::now();
    while (!dealer.done()) {
      if (end.stop_requested()) {
        dealer.stop();
      }
      const bool mail = dealer.read_mail(records);
      const bool answer = dealer.collect_own(records);
      const auto now = std::chrono::steady_clock::now();
      if (!records.empty() || now >= next_take) {
        take(std::exchange(records, {}));
        next_take = now + kTakePause;
      }
      if (!mail && !answer) {
        std::this_thread::sleep_for(kPause);
      }
    }
  } catch (...) {
    end.request_stop();
    throw;
  }
  for (int rank = 1; rank < world_.size(); ++rank) {
    world_.send(rank, kRest);
  }
}

void MpiTeam::serve(const RunExecutor& executor) {
  std::signal(SIGINT, SIG_IGN);  // the leader hears of it, and says when all is done
  world_.send(kLeader, kReady);
  while (true) {
    const boost::optional<mpi::status> mail = world_.iprobe(kLeader, mpi::any_tag);
    if (!mail) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (mail->tag() == kRun) {
      RunSpec spec;
      world_.recv(kLeader, kRun, spec);
      if (std::optional<RunRecord> record = executor.run(spec)) {
        world_.send(kLeader, kRecord, *record);
      } else {
        world_.send(kLeader, kDropped);
      }
      continue;
    }
    world_.recv(kLeader, mail->tag());
    if (mail->tag() == kRest) {
      return;
    }
    throw std::runtime_error("the process that leads has given up");
  }
}

void MpiTeam::decline(const std::string& reason) { world_.send(kLeader, kFailed, reason); }

}  // namespace handway::campaign_mpi

// Entry point for programs that mpirun started: see join_process_team().
extern "C" __attribute__((visibility("default"))) handway::planning::ProcessTeam*
handway_process_team() {
  return new handway::campaign_mpi::MpiTeam();
}
