// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>

#include <fiberloom/output/checkpoint.h>
#include <fiberloom/output/checkpoint_archive.h>
#include <fiberloom/output/files.h>

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/impl/archive_serializer_map.ipp>
#include <boost/archive/impl/basic_binary_iarchive.ipp>
#include <boost/archive/impl/basic_binary_iprimitive.ipp>
#include <boost/crc.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace boost
{
  namespace archive
  {
    template class detail::archive_serializer_map<fiberloom::CheckpointArchive>;
    template class basic_binary_iprimitive<fiberloom::CheckpointArchive,
                                           char,
                                           std::char_traits<char>>;
    template class basic_binary_iarchive<fiberloom::CheckpointArchive>;
    template class binary_iarchive_impl<fiberloom::CheckpointArchive,
                                        char,
                                        std::char_traits<char>>;
  } // namespace archive

  namespace serialization
  {
    template <class Archive>
    void
    serialize(Archive &ar, fiberloom::TurningPoint &point, const unsigned int)
    {
      ar &point.part &point.work &point.friction &point.stored;
    }

    template <class Archive>
    void
    serialize(Archive &ar, fiberloom::StageStatistics &s, const unsigned int)
    {
      ar &s.name &s.converged &s.increments &s.rejected_increments;
      ar &s.contact_updates &s.normal_updates &s.newton_iterations;
      ar &s.linear_iterations &s.factorizations;
      ar &s.largest_penetration_over_radius &s.crossings_out_of_order;
      ar                                    &s.contact_elements;
      ar &s.seconds.detection &s.seconds.assembly &s.seconds.linear_solver;
      ar &s.seconds.analysis &s.seconds.factorization &s.seconds.krylov;
      ar &s.seconds.output &s.seconds.wall &s.seconds.yardstick;
      ar &s.unsymmetric_systems &s.searches &s.friction_history;
      ar &s.estimated_error.mesh &s.estimated_error.stations;
      ar &s.estimated_error.penetration &s.estimated_error.total;
      ar &s.estimated_error.matrix &s.estimated_error.tolerance;
      ar &s.seconds.estimate &s.seconds.coarse &s.coarse_iterations;
      ar &s.largest_section_change &s.elastic_energy &s.negative_pivots;
      ar &s.membrane_stiffness &s.filled_thickness &s.turning_points &s.broken;
    }

    template <class Archive>
    void
    serialize(Archive &ar, fiberloom::Column &column, const unsigned int)
    {
      ar &column.name &column.quantity &column.role &column.family;
    }

    template <class Archive>
    void
    serialize(Archive &ar, fiberloom::OutputRecord &output, const unsigned int)
    {
      ar &output.tables &output.columns &output.fields &output.log_size;
    }
  } // namespace serialization
} // namespace boost

namespace fiberloom
{
  namespace
  {
    const std::string checkpoint_magic = "fiberloom checkpoint\n";

    // Then version, size and checksum of the rest.
    const std::size_t size_of_start =
      checkpoint_magic.size() + 3 * sizeof(std::uint64_t);

    // to be raised with every change of what is serialised
    constexpr std::uint64_t checkpoint_version = 11;

    // Two million nodes take a twentieth.
    constexpr std::uintmax_t most_bytes = 20000000000;

    std::string
    words(const std::initializer_list<std::uint64_t> &values)
    {
      std::string bytes;
      for (const std::uint64_t value : values)
        bytes.append(reinterpret_cast<const char *>(&value), sizeof(value));
      return bytes;
    }

    std::uint64_t
    checksum(const std::string &bytes)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data(), bytes.size());
      return crc.checksum();
    }

    /** Takes a file apart from its beginning. */
    class CheckpointReader
    {
    public:
      CheckpointReader(const std::string &content, const std::string &file)
        : content(content)
        , file(file)
      {}

      std::string
      take(const std::uint64_t n)
      {
        if (n > content.size() - position)
          fail("is truncated");
        position += n;
        return content.substr(position - n, n);
      }

      std::uint64_t
      word()
      {
        std::uint64_t value;
        std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
        return value;
      }

      [[noreturn]] void
      fail(const std::string &reason) const
      {
        throw InputError(file + ": this checkpoint " + reason);
      }

    private:
      const std::string &content;
      const std::string &file;
      std::size_t        position = 0;
    };
  } // namespace



  namespace
  {
    /** Over and under of all crossings, one digit each; empty for no fabric. */
    std::string
    superimposition_order(const FiberSet &fibers)
    {
      std::string order;
      if (fibers.pattern)
        for (const Tow &warp : fibers.tows)
          for (const Tow &fill : fibers.tows)
            if (warp.family == Tow::Family::warp &&
                fill.family == Tow::Family::fill)
              order += fibers.pattern->warp_above(warp.number, fill.number) ?
                         '1' :
                         '0';
      return order;
    }
  } // namespace



  std::string
  describe_model(const FiberSet &fibers, const FiberMesh &mesh)
  {
    boost::crc_32_type crc;
    const auto         add = [&crc](const double value, const double unit) {
      // Rounded, since another compiler may differ in the last digits; the
      // shift keeps round numbers away from where rounding changes.
      const std::int64_t rounded = std::llround(value / unit + .23);
      crc.process_bytes(&rounded, sizeof(rounded));
    };
    for (unsigned int f = 0; f < mesh.lines().size(); ++f)
      {
        const FiberMesh::Line &line = mesh.lines()[f];
        add(line.tow, 1);
        add(line.n_elements, 1);
        add(std::log(line.radius), 1e-6);
        add(std::log(line.young_modulus), 1e-6);
        add(fibers.fibers[f].poisson_ratio, 1e-6);
        // Not of the other one: checkpoints from before there was a choice.
        if (fibers.fibers[f].law == AxialLaw::linear)
          add(1, 1);
        for (unsigned int i = 9 * line.first_node;
             i < 9 * (line.first_node + line.n_nodes());
             ++i)
          {
            add(mesh.reference()[i], 1e-4 * line.radius);
            if (fibers.fibers[f].initial)
              add(mesh.initial()[i], 1e-4 * line.radius);
          }
      }
    for (unsigned int d = 0; fibers.cell && d < 2; ++d)
      add(std::log((*fibers.cell)[d]), 1e-6);
    const std::string order = superimposition_order(fibers);
    crc.process_bytes(order.data(), order.size());

    std::ostringstream out;
    out << mesh.lines().size() << " fibers, " << mesh.n_nodes()
        << " nodes, geometry, materials and weave " << std::hex
        << crc.checksum();
    return out.str();
  }



  std::string
  encode_checkpoint(const Checkpoint &checkpoint, const std::string &model)
  {
    std::ostringstream payload;
    {
      boost::archive::binary_oarchive archive(payload);
      archive << checkpoint.state << checkpoint.stages << checkpoint.run
              << checkpoint.output;
    }
    const std::string body = words({model.size()}) + model + payload.str();
    return checkpoint_magic +
           words({checkpoint_version, body.size(), checksum(body)}) + body;
  }



  namespace
  {
    [[noreturn]] void
    fail_as_other_file(const std::string &file)
    {
      throw InputError(file + ": is not a checkpoint of fiberloom, or damaged");
    }

    /** Of a file of @p size bytes that begins with @p start . */
    void
    check_start(const std::string  &start,
                const std::uint64_t size,
                const std::string  &file)
    {
      if (start.compare(0, checkpoint_magic.size(), checkpoint_magic) != 0)
        fail_as_other_file(file);
      CheckpointReader reader(start, file);
      reader.take(checkpoint_magic.size());
      const std::uint64_t version = reader.word();
      if (version != checkpoint_version)
        reader.fail("has format " + std::to_string(version) +
                    ", this program reads format " +
                    std::to_string(checkpoint_version));
      const std::uint64_t body = reader.word();
      reader.word();
      if (body != size - size_of_start)
        reader.fail(body > size - size_of_start ? "is truncated" :
                                                  "is damaged");
    }

    /** Looks at the kind of file and at its first bytes before the rest. */
    std::string
    read_checkpoint_file(const std::string &file)
    {
      std::ifstream in;
      try
        {
          in = open_input_file(file, most_bytes);
        }
      catch (const InputError &error)
        {
          throw InputError(file + ": " + error.what());
        }
      std::string start(size_of_start, ' ');
      in.read(start.data(), start.size());
      start.resize(in.gcount());
      in.clear();
      in.seekg(0, std::ios::end);
      check_start(start, in.tellg(), file);
      return read_file(file);
    }
  } // namespace



  Checkpoint
  decode_checkpoint(const std::string &content,
                    const std::string &model,
                    const std::string &file)
  {
    check_start(content, content.size(), file);
    CheckpointReader reader(content, file);
    reader.take(size_of_start - sizeof(std::uint64_t));
    const std::uint64_t sum  = reader.word();
    const std::string   body = content.substr(size_of_start);
    if (checksum(body) != sum)
      reader.fail("is damaged");

    CheckpointReader  body_reader(body, file);
    const std::string its_model = body_reader.take(body_reader.word());
    if (its_model != model)
      reader.fail("belongs to another model (" + its_model +
                  "; the scene has " + model + ")");

    Checkpoint checkpoint;
    try
      {
        std::istringstream input(
          body.substr(sizeof(std::uint64_t) + its_model.size()));
        CheckpointArchive archive(input);
        archive >> checkpoint.state >> checkpoint.stages >> checkpoint.run >>
          checkpoint.output;
      }
    catch (const std::exception &)
      {
        reader.fail("was written with other libraries and cannot be read");
      }
    return checkpoint;
  }



  void
  write_checkpoint(const std::string &file,
                   const Checkpoint  &checkpoint,
                   const std::string &model,
                   const MPI_Comm     comm)
  {
    collectively(comm, [&]() {
      if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
        write_file(file,
                   encode_checkpoint(checkpoint, model),
                   Durability::on_disk);
    });
  }



  Checkpoint
  read_checkpoint(const std::string &file,
                  const std::string &model,
                  const MPI_Comm     comm)
  {
    std::string content, error;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          content = read_checkpoint_file(file);
        }
      catch (const InputError &e)
        {
          error = e.what();
        }
    error = dealii::Utilities::MPI::broadcast(comm, error, 0);
    if (!error.empty())
      throw InputError(error);
    return decode_checkpoint(
      dealii::Utilities::MPI::broadcast(comm, content, 0), model, file);
  }
} // namespace fiberloom
