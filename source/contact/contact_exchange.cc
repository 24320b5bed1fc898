// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_exchange.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace fiberloom
{
  namespace
  {
    template <typename T>
    struct Gathered
    {
      std::vector<T>   values;
      std::vector<int> counts; // by rank
    };

    /** Of plain values, which are exchanged as bytes: there are too many to be
     * serialised. */
    template <typename T>
    Gathered<T>
    gather(const MPI_Comm comm, const std::vector<T> &mine)
    {
      Gathered<T> all;
      all.counts =
        dealii::Utilities::MPI::all_gather(comm, static_cast<int>(mine.size()));
      std::vector<int> begins(all.counts.size());
      std::exclusive_scan(all.counts.begin(),
                          all.counts.end(),
                          begins.begin(),
                          0);
      all.values.resize(begins.back() + all.counts.back());

      MPI_Datatype type;
      MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
      MPI_Type_commit(&type);
      MPI_Allgatherv(mine.data(),
                     mine.size(),
                     type,
                     all.values.data(),
                     all.counts.data(),
                     begins.data(),
                     type,
                     comm);
      MPI_Type_free(&type);
      return all;
    }

    /** A zone without its lists. */
    struct PlainZone
    {
      std::array<unsigned int, 2>          fibers;
      std::array<std::array<double, 2>, 2> range;
      bool                                 crossing;
      int                                  side;
      unsigned int                         n_parts, n_divided;
    };
  } // namespace



  std::pair<std::size_t, std::size_t>
  part_of_rank(const MPI_Comm comm, const std::size_t n)
  {
    const std::size_t rank    = dealii::Utilities::MPI::this_mpi_process(comm),
                      n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
    return {rank * n / n_ranks, (rank + 1) * n / n_ranks};
  }



  void
  gather_contacts(const MPI_Comm               comm,
                  std::vector<ContactZone>    &zones,
                  std::vector<ContactElement> &contacts)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
      return;

    std::vector<PlainZone>                    plain;
    std::vector<std::pair<double, double>>    parts;
    std::vector<std::pair<int, unsigned int>> divided;
    for (const ContactZone &zone : zones)
      {
        plain.push_back({zone.fibers,
                         zone.range,
                         zone.crossing,
                         zone.side,
                         static_cast<unsigned int>(zone.stiffness.size()),
                         static_cast<unsigned int>(zone.divided.size())});
        parts.insert(parts.end(), zone.stiffness.begin(), zone.stiffness.end());
        divided.insert(divided.end(), zone.divided.begin(), zone.divided.end());
      }
    const auto all_plain    = gather(comm, plain);
    const auto all_parts    = gather(comm, parts);
    const auto all_divided  = gather(comm, divided);
    auto       all_contacts = gather(comm, contacts);

    zones.clear();
    zones.reserve(all_plain.values.size());
    auto part = all_parts.values.begin();
    auto cell = all_divided.values.begin();
    for (const PlainZone &zone : all_plain.values)
      {
        zones.push_back({zone.fibers,
                         zone.range,
                         zone.crossing,
                         zone.side,
                         {part, part + zone.n_parts},
                         {cell, cell + zone.n_divided}});
        part += zone.n_parts;
        cell += zone.n_divided;
      }

    unsigned int first_zone = 0, contact = 0;
    for (unsigned int rank = 0; rank < all_plain.counts.size(); ++rank)
      {
        for (int i = 0; i < all_contacts.counts[rank]; ++i)
          all_contacts.values[contact++].zone += first_zone;
        first_zone += all_plain.counts[rank];
      }
    contacts = std::move(all_contacts.values);
  }
} // namespace fiberloom
