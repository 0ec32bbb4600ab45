#include "handway/geometric/io/input_error.h"
#include "handway/planning/campaigns/run_workers.h"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>

#include <cstdlib>
#include <exception>
#include <filesystem>

namespace handway::planning {

std::unique_ptr<ProcessTeam> join_process_team() {
  constexpr const char* kEntryPoint = "handway_process_team";
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {  // set by Open MPI's mpirun
    return nullptr;
  }
  const boost::filesystem::path file = boost::dll::program_location().parent_path().parent_path() /
                                       "lib" / "handway-mpi" / "process_team_mpi.so";
  // Stays loaded to the very end: MPI's own threads and handlers live there.
  static auto& library = *new boost::dll::shared_library;
  try {
    library.load(file, boost::dll::load_mode::rtld_global | boost::dll::load_mode::rtld_now);
    return std::unique_ptr<ProcessTeam>(library.get<ProcessTeam*()>(kEntryPoint)());
  } catch (const std::exception& error) {
    throw geometric::InputError({file.string(), "", error.what(),
                                 "the library that talks to mpirun",
                                 "Build Handway with MPI, or start it without mpirun"});
  }
}

}  // namespace handway::planning
