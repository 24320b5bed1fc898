// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_contact_contact_exchange_h
#define fiberloom_contact_contact_exchange_h

#include <fiberloom/contact/contact_element.h>
#include <fiberloom/contact/contact_state.h>

#include <mpi.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace fiberloom
{
  /** The part of @p n things that this rank is to look after: begin and end of
   * one of as many ranges of nearly equal length as there are ranks. */
  std::pair<std::size_t, std::size_t>
  part_of_rank(const MPI_Comm comm, const std::size_t n);

  /** Replaces what each rank has by that of all, in the order of ranks.
   * @p contacts tell their zone by its place in @p zones . Collective. */
  void
  gather_contacts(const MPI_Comm               comm,
                  std::vector<ContactZone>    &zones,
                  std::vector<ContactElement> &contacts);
} // namespace fiberloom

#endif
