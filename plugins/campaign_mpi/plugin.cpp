#include "mpi_team.h"

// The way in for programs that mpirun started: see join_process_team().
extern "C" __attribute__((visibility("default"))) handway::planning::ProcessTeam*
handway_process_team() {
  return new handway::campaign_mpi::MpiTeam();
}
