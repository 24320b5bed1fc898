// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A run that is interrupted and continued leaves the same files as one that
// is not, and all that are promised. Nobody else can have its directory.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/directory_lock.h>
#include <fiberloom/output/files.h>
#include <fiberloom/output/writer.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace fiberloom;

namespace
{
  FiberSet
  two_fibers()
  {
    FiberSet fibers;
    for (unsigned int f = 0; f < 2; ++f)
      {
        Fiber fiber{f, .01, 73000, .22, {}, {}, {}};
        for (unsigned int n = 0; n < 9; ++n)
          {
            fiber.centers.emplace_back(n / 8. - .5, .021 * f, 0);
            fiber.directions_1.push_back(Vector3::UnitY());
            fiber.directions_2.push_back(Vector3::UnitZ());
          }
        fibers.fibers.push_back(fiber);
        fibers.tows.push_back({Tow::Family::warp, f, .021 * f, .01, .01, {f}});
      }
    return fibers;
  }

  ContactElement
  some_contact()
  {
    ContactElement contact{};
    contact.fibers       = {{0, 1}};
    contact.points       = {{{1, .5}, {5, .5}}};
    contact.normal       = -Vector3::UnitY();
    contact.particles    = {{{{1, 0}}, {{-1, 0}}}};
    contact.normal_force = 3;
    return contact;
  }

  void
  increment(OutputWriter      &writer,
            const FiberMesh   &mesh,
            State             &state,
            const std::string &stage)
  {
    const unsigned int n = 3;
    ++state.increment;
    state.load = double(state.increment) / n;
    state.q    = (1 + .01 * state.load) * mesh.reference();

    const std::vector<ContactElement> contacts(5, some_contact());
    const StageStatistics             statistics;
    Supports                          supports;
    supports.bodies.resize(2);
    supports.bodies[0].name = "left";
    supports.bodies[1].name = "right";
    state.placements.resize(2);
    state.placements[1].position = Vector3(1, 2, 3);
    const std::vector<BodyVector> reactions{-state.load * BodyVector::Ones(),
                                            BodyVector::LinSpaced(1, 6)};
    writer({stage,
            state,
            contacts,
            supports,
            reactions,
            {{{"strain_warp", Quantity::strain, Role::deformation}, state.load},
             {{"force_warp", Quantity::force, Role::response}, state.load}},
            statistics,
            state.increment == n});
  }

  /** Both stages of a scene, or increments from @p checkpoint on. */
  void
  run(const Parameters  &parameters,
      const unsigned int n_increments,
      const bool         restart)
  {
    const FiberSet      fibers = two_fibers();
    const FiberMesh     mesh(fibers);
    const std::string  &directory = parameters.output_directory;
    const DirectoryLock lock(directory, MPI_COMM_WORLD);
    const RunIdentity   identity = new_run(parameters, MPI_COMM_WORLD);
    Log                 log(MPI_COMM_WORLD);
    OutputWriter        writer(
      {parameters, fibers, mesh}, ModelSize(), identity, log, MPI_COMM_WORLD);

    State state;
    state.q = mesh.reference();
    if (restart)
      {
        const Checkpoint checkpoint =
          read_checkpoint(directory + "/checkpoint",
                          describe_model(fibers, mesh),
                          MPI_COMM_WORLD);
        state = checkpoint.state;
        writer.continue_from(checkpoint);
      }
    writer.begin(state);
    for (unsigned int i = 0; i < n_increments; ++i)
      {
        writer.begin_stage(parameters.stages[state.stage], state);
        increment(writer, mesh, state, parameters.stages[state.stage]);
        if (state.load == 1)
          {
            state.begin_stage(state.stage + 1);
            writer.end_stage(state);
          }
      }
  }

  template <class Error>
  std::string
  message(const std::function<void()> &work)
  {
    try
      {
        work();
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "nothing";
  }

  /** What a run says that goes on where no file may grow beyond some rows. */
  std::string
  message_of_full_disk(Parameters parameters)
  {
    parameters.output_directory = "full";
    run(parameters, 2, false);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limits;
    getrlimit(RLIMIT_FSIZE, &limits);
    const rlimit small = {500, limits.rlim_max};
    return message<StageFailure>([&]() {
      setrlimit(RLIMIT_FSIZE, &small);
      try
        {
          run(parameters, 1, true);
        }
      catch (...)
        {
          setrlimit(RLIMIT_FSIZE, &limits);
          throw;
        }
    });
  }

  std::set<std::string>
  files(const std::string &directory)
  {
    std::set<std::string> names;
    for (const auto &entry :
         std::filesystem::recursive_directory_iterator(directory))
      names.insert(std::filesystem::relative(entry.path(), directory).string());
    return names;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  // Of an earlier call.
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    for (const char *former : {"straight", "interrupted", "full"})
      std::filesystem::remove_all(former);

  Parameters parameters;
  parameters.stages                  = {"relax", "biaxial"};
  parameters.output.checkpoint_every = 2;
  parameters.output.slices_every     = 2;

  parameters.output_directory = "straight";
  run(parameters, 6, false);
  // the last increment before the interruption is after the checkpoint
  parameters.output_directory = "interrupted";
  run(parameters, 4, false);
  run(parameters, 3, true);
  const std::string full = message_of_full_disk(parameters);
  std::string       refused;
  {
    const DirectoryLock lock("straight", MPI_COMM_WORLD);
    refused =
      message<InputError>([&]() { DirectoryLock("straight", MPI_COMM_WORLD); });
  }
  const std::set<std::string> left = files("straight");

  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return 0;
  std::ofstream out("output");
  for (const auto &name : files("straight"))
    if (name.find('/') == std::string::npos ||
        name.find(".vtu") == std::string::npos)
      out << name << "\n";
  out << "same files " << (files("straight") == files("interrupted")) << "\n";
  for (const char *name : {"fibers.pvd",
                           "sections.pvd",
                           "contacts.pvd",
                           "loading_curve.csv",
                           "reactions.csv",
                           "trajectories.csv",
                           "fields/fibers_biaxial_0002_0.vtu",
                           "slices/warp_biaxial_0002.svg",
                           "slices/warp_biaxial_0003.svg",
                           "pictures/loading_curve_biaxial.svg"})
    out << "same " << name << " "
        << (read_file(std::string("straight/") + name) ==
            read_file(std::string("interrupted/") + name))
        << "\n";
  out << "a second run is refused "
      << (refused.find("in use by process " + std::to_string(getpid())) !=
          std::string::npos)
      << ", no lock is left " << (left.count("lock") == 0) << "\n";
  std::istringstream reactions(read_file("straight/reactions.csv"));
  std::string        line;
  for (unsigned int i = 0; i < 3 && std::getline(reactions, line); ++i)
    out << line << "\n";
  const std::string before = read_file("full/reactions.csv");
  out << full << "; left with rows "
      << std::count(before.begin(), before.end(), '\n') - 1 << "\n";
}
