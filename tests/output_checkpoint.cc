// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A checkpoint comes back bit for bit, and a file that is no good for this run
// is refused with one line that says why. When the disk takes no more the
// former file stays as it was. What was planted under a temporary name is
// replaced, not followed and not waited for.

#include <fiberloom/base/exceptions.h>

#include <fiberloom/output/checkpoint.h>
#include <fiberloom/output/files.h>

#include <deal.II/base/mpi.h>

#include <boost/crc.hpp>

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

using namespace fiberloom;

namespace
{
  Checkpoint
  some_checkpoint()
  {
    Checkpoint checkpoint;
    State     &state = checkpoint.state;
    state.q          = DofVector::Constant(18, 1. / 3);
    state.q[3]       = -0.1;
    state.placements.resize(2);
    state.placements[1].position = Vector3(1. / 7, 2, 3);
    state.placements[1].rotation = Eigen::AngleAxisd(.3, Vector3(1, 2, 2) / 3.);
    state.placements[1].turn     = Vector3(20, -1. / 3, 0);
    state.stage_start_q          = DofVector::Constant(18, 1. / 7);
    state.dissipation            = 1e-7 / 3;
    state.contact.zones.resize(1);
    state.contact.zones[0].fibers    = {{4, 9}};
    state.contact.zones[0].range     = {{{{.1, .2}}, {{.3, .4}}}};
    state.contact.zones[0].stiffness = {{.15, 1e5 / 3}, {.2, 1e4}};
    state.contact.zones[0].side      = -1;
    state.contact.history.push_back({{{4, 9}}, {{.15, .35}}, {1e-9, 2, -3}});
    state.stage       = 1;
    state.increment   = 7;
    state.load        = .7;
    state.step        = .1;
    state.stages_done = {"weave"};

    checkpoint.stages.resize(2);
    checkpoint.stages[0].name                            = "weave";
    checkpoint.stages[0].converged                       = true;
    checkpoint.stages[1].largest_penetration_over_radius = .02 / 3;
    checkpoint.stages[1].largest_section_change          = .004 / 3;
    checkpoint.stages[1].elastic_energy                  = .0195 / 3;
    checkpoint.stages[1].negative_pivots                 = 2;
    checkpoint.stages[1].seconds.detection               = 1.5;
    checkpoint.run                       = {"0123", "set a = b\n"};
    checkpoint.output.tables["some.csv"] = "stage,increment,load\n";
    checkpoint.output.fields["fibers"]   = {{1. / 3, "fields/some.pvtu"}};
    checkpoint.output.log_size           = 77;
    return checkpoint;
  }

  bool
  equal(const Checkpoint &a, const Checkpoint &b)
  {
    const State &s = a.state, &t = b.state;
    const auto  &z = s.contact.zones[0], &y = t.contact.zones[0];
    return s.q == t.q && s.placements.size() == t.placements.size() &&
           s.placements[1].position == t.placements[1].position &&
           s.placements[1].rotation.coeffs() ==
             t.placements[1].rotation.coeffs() &&
           s.placements[1].turn == t.placements[1].turn &&
           s.stage_start_q == t.stage_start_q &&
           s.dissipation == t.dissipation && z.fibers == y.fibers &&
           z.range == y.range && z.side == y.side &&
           z.stiffness == y.stiffness &&
           s.contact.history[0].slip == t.contact.history[0].slip &&
           s.contact.history[0].u == t.contact.history[0].u &&
           s.stage == t.stage && s.increment == t.increment &&
           s.load == t.load && s.step == t.step &&
           s.stages_done == t.stages_done &&
           a.stages.size() == b.stages.size() &&
           a.stages[0].name == b.stages[0].name &&
           a.stages[0].converged == b.stages[0].converged &&
           a.stages[1].largest_penetration_over_radius ==
             b.stages[1].largest_penetration_over_radius &&
           a.stages[1].largest_section_change ==
             b.stages[1].largest_section_change &&
           a.stages[1].elastic_energy == b.stages[1].elastic_energy &&
           a.stages[1].negative_pivots == b.stages[1].negative_pivots &&
           a.stages[1].seconds.detection == b.stages[1].seconds.detection &&
           a.run.id == b.run.id && a.run.asked == b.run.asked &&
           a.output.tables == b.output.tables &&
           a.output.fields == b.output.fields &&
           a.output.log_size == b.output.log_size;
  }

  // behind the first line, format, size and checksum
  constexpr std::size_t start_of_body = 21 + 3 * 8;

  /** The content with the checksum of what is behind it. */
  std::string
  with_checksum(std::string content)
  {
    boost::crc_32_type crc;
    crc.process_bytes(content.data() + start_of_body,
                      content.size() - start_of_body);
    const std::uint64_t sum = crc.checksum();
    std::memcpy(&content[start_of_body - 8], &sum, sizeof(sum));
    return content;
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
    return "nothing is wrong";
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           comm = MPI_COMM_WORLD;
  std::ofstream                            out("output");

  const std::string model   = "9 fibers, 2 nodes";
  const Checkpoint  written = some_checkpoint();
  write_checkpoint("saved", written, model, comm);
  const Checkpoint read = read_checkpoint("saved", model, comm);
  out << "equal " << equal(written, read) << "\n";
  out << "nothing left aside " << !std::filesystem::exists("saved.tmp") << "\n";

  const std::string content = read_file("saved");
  const auto refusal = [&](const std::string &wrong, const std::string &its) {
    return message<InputError>(
      [&]() { decode_checkpoint(wrong, its, "file"); });
  };

  // every cut and every spoilt byte is noticed
  unsigned int missed = 0;
  for (std::size_t i = 0; i < content.size(); ++i)
    {
      std::string spoilt = content;
      spoilt[i] ^= 0x10;
      missed += refusal(content.substr(0, i), model) == "nothing is wrong";
      missed += refusal(spoilt, model) == "nothing is wrong";
    }
  out << "damages missed " << missed << "\n";

  // bytes that no program wrote, but with a checksum that fits: refused, or
  // other values, and never longer lists than the file has room for
  unsigned int too_long = 0;
  for (std::size_t i = start_of_body; i < content.size(); ++i)
    for (const char bits : {0x01, 0x40, 0x7f})
      {
        std::string spoilt = content;
        spoilt[i] ^= bits;
        message<InputError>([&]() {
          const Checkpoint other =
            decode_checkpoint(with_checksum(spoilt), model, "file");
          too_long += other.state.q.size() > Eigen::Index(content.size()) ||
                      other.state.contact.zones.capacity() > content.size();
        });
      }
  out << "lists believed longer than the file " << too_long << "\n";

  std::string other_version = content;
  other_version[21]         = 99;
  std::string spoilt        = content;
  spoilt[content.size() / 2] ^= 1;
  out << refusal(content.substr(0, content.size() - 9), model) << "\n"
      << refusal(spoilt, model) << "\n"
      << refusal(content + "x", model) << "\n"
      << refusal("set Stages = weave", model) << "\n"
      << refusal(other_version, model) << "\n"
      << refusal(content, "another model") << "\n"
      << message<InputError>([&]() { read_checkpoint("absent", model, comm); })
      << "\n";

  // a disk that takes no more
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limits;
  getrlimit(RLIMIT_FSIZE, &limits);
  const rlimit small = {content.size() / 2, limits.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string full = message<StageFailure>(
    [&]() { write_checkpoint("saved", written, "new", comm); });
  setrlimit(RLIMIT_FSIZE, &limits);
  out << full << "\n"
      << "former file intact " << (read_file("saved") == content)
      << ", nothing left aside " << !std::filesystem::exists("saved.tmp")
      << "\n";

  // Planted: a link to something precious, and pipes.
  for (const char *former : {"saved.tmp", "linked", "pipe", "pipe.tmp"})
    std::filesystem::remove(former);
  write_file("precious", "precious");
  std::filesystem::create_symlink("precious", "saved.tmp");
  write_checkpoint("saved", written, model, comm);
  out << "what a link leads to stays " << (read_file("precious") == "precious");
  std::filesystem::create_symlink("precious", "linked");
  write_file("linked", "new");
  out << " " << (read_file("precious") == "precious");
  mkfifo("pipe.tmp", 0600);
  mkfifo("pipe", 0600);
  write_file("pipe", "new", Durability::on_disk);
  out << ", pipes are replaced " << (read_file("pipe") == "new") << "\n";
}
