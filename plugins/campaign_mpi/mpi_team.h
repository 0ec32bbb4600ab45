#pragma once

#include "handway/planning/campaigns/run_workers.h"

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

#include <string>

namespace handway::campaign_mpi {

/// The processes of one `mpirun`, a run at a time on each. Rank 0 leads: it deals out runs one
/// by one to whoever is free, itself included (on a second thread), and collects the
/// records. Nobody waits busily.
///
/// One each process, made before anything else talks to MPI.
class MpiTeam final : public planning::ProcessTeam {
 public:
  MpiTeam();
  /// The leader sends the others home.
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

}  // namespace handway::campaign_mpi
