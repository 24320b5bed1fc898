// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/solvers/direct_factor.h>
#include <fiberloom/solvers/rigid_sections.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <dmumps_c.h>
#include <metis.h>
#include <smumps_c.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

#ifdef __SSE2__
#  include <xmmintrin.h>
#endif

namespace fiberloom
{
  class DirectFactor::Implementation
  {
  public:
    virtual ~Implementation() = default;

    virtual void
    analyse(const BlockMatrix &matrix) = 0;

    virtual void
    forget() = 0;

    virtual int
    factorize(const BlockMatrix &matrix, const double dropped) = 0;

    virtual void
    solve(const BlockLayout &layout, double *owned_values) = 0;
  };



  namespace
  {
    /**
     * While one lives, subnormal numbers count as zero. Where most of a
     * structure is at rest, a single-precision factor is full of them, and
     * arithmetic with them takes five times as long.
     */
    class FlushSubnormals
    {
#ifdef __SSE2__
    public:
      FlushSubnormals()
        : before(_mm_getcsr())
      {
        constexpr unsigned int results = 0x8000, operands = 0x0040;
        _mm_setcsr(before | results | operands);
      }

      ~FlushSubnormals()
      {
        _mm_setcsr(before);
      }

      FlushSubnormals(const FlushSubnormals &) = delete;

      FlushSubnormals &
      operator=(const FlushSubnormals &) = delete;

    private:
      const unsigned int before;
#endif
    };



    void
    call(DMUMPS_STRUC_C &data)
    {
      const FlushSubnormals flush;
      dmumps_c(&data);
    }

    void
    call(SMUMPS_STRUC_C &data)
    {
      const FlushSubnormals flush;
      smumps_c(&data);
    }

    /** MUMPS counts its control parameters from one. */
    template <typename Mumps>
    int &
    control(Mumps &data, const unsigned int index)
    {
      return data.icntl[index - 1];
    }

    bool
    is_in(const DirectFactor::Part part,
          const BlockLayout       &layout,
          const unsigned int       block)
    {
      return part == DirectFactor::Part::all ||
             layout.is_matrix_node(block) ==
               (part == DirectFactor::Part::matrix);
    }

    // Of each owned block, the coupled ones from the diagonal on.
    using Couplings = std::vector<std::vector<unsigned int>>;

    // Blocks that have become zero cost less than a new analysis, up to this
    // part of those that are not.
    constexpr double largest_surplus = .1;

    // An ordering is kept while the factor takes no more operations than this
    // over those that it took when it was made.
    constexpr double largest_growth = 1.15;

    // Blocks from which the factor costs much more than the ordering.
    constexpr int costly_from = 50000;

    /** Number of couplings on all ranks. */
    std::size_t
    sum(const MPI_Comm comm, const Couplings &couplings)
    {
      std::size_t size = 0;
      for (const auto &row : couplings)
        size += row.size();
      return dealii::Utilities::MPI::sum(size, comm);
    }

    /** The blocks of @p matrix that a factor has to know: contacts that are
     * open leave theirs zero. */
    Couplings
    couplings_in(const BlockMatrix          &matrix,
                 const DirectFactor::Part    part,
                 const DirectFactor::Entries entries)
    {
      const BlockLayout &layout = matrix.layout();
      Couplings          found(layout.owned_blocks().size());
      for (unsigned int row = 0; row < found.size(); ++row)
        {
          const unsigned int block   = layout.owned_blocks()[row];
          const auto        &columns = matrix.columns(row);
          found[row].push_back(block);
          if (is_in(part, layout, block))
            for (unsigned int c = 0; c < columns.size(); ++c)
              if (columns[c] > block && is_in(part, layout, columns[c]))
                {
                  const double *begin = matrix.values(row, c);
                  const double *end =
                    begin + layout.size(block) * layout.size(columns[c]);
                  if (entries == DirectFactor::Entries::all ||
                      std::any_of(begin, end, [](const double entry) {
                        return entry != 0;
                      }))
                    found[row].push_back(columns[c]);
                }
        }
      return found;
    }

    /** Whether @p blocks are all in @p analysed , on every rank. */
    bool
    covers(const MPI_Comm   comm,
           const Couplings &analysed,
           const Couplings &blocks)
    {
      bool covered = analysed.size() == blocks.size();
      for (unsigned int row = 0; row < blocks.size() && covered; ++row)
        covered = std::includes(analysed[row].begin(),
                                analysed[row].end(),
                                blocks[row].begin(),
                                blocks[row].end());
      return dealii::Utilities::MPI::min(int(covered), comm) == 1;
    }

    Couplings
    merged(const Couplings &a, const Couplings &b)
    {
      Couplings merged(a.size());
      for (unsigned int row = 0; row < a.size(); ++row)
        std::set_union(a[row].begin(),
                       a[row].end(),
                       b[row].begin(),
                       b[row].end(),
                       std::back_inserter(merged[row]));
      return merged;
    }

    /** Where parts of these sizes begin, one after the other. */
    std::vector<int>
    begins_of(const std::vector<int> &counts)
    {
      std::vector<int> begins(counts.size());
      std::exclusive_scan(counts.begin(), counts.end(), begins.begin(), 0);
      return begins;
    }

    /** Those of all ranks, one after the other, on rank 0. */
    std::vector<idx_t>
    gathered(const MPI_Comm comm, const std::vector<idx_t> &own)
    {
      static_assert(sizeof(idx_t) == sizeof(int));
      const int  n_own  = own.size();
      const auto counts = dealii::Utilities::MPI::gather(comm, n_own, 0);
      const std::vector<int> begins = begins_of(counts);
      std::vector<idx_t>     all(
        std::accumulate(counts.begin(), counts.end(), std::size_t(0)));
      MPI_Gatherv(own.data(),
                  n_own,
                  MPI_INT,
                  all.data(),
                  counts.data(),
                  begins.data(),
                  MPI_INT,
                  0,
                  comm);
      return all;
    }

    /** Whether @p blocks are hardly more than @p needed , over all ranks. */
    bool
    is_lean(const MPI_Comm   comm,
            const Couplings &blocks,
            const Couplings &needed)
    {
      return sum(comm, blocks) <= (1 + largest_surplus) * sum(comm, needed);
    }

    /** Position of each dof in the pivot order (from one), by METIS's nested
     * dissection of all blocks; @p couples are rows and columns of one half.
     * Empty where METIS fails. */
    std::vector<int>
    dissected(const BlockLayout &layout, const std::vector<idx_t> &couples)
    {
      idx_t              n = layout.n_blocks();
      std::vector<idx_t> begin(n + 1, 0), weights(n);
      for (idx_t block = 0; block < n; ++block)
        weights[block] = layout.size(block);
      for (const idx_t block : couples)
        ++begin[block + 1];
      std::partial_sum(begin.begin(), begin.end(), begin.begin());
      std::vector<idx_t> neighbours(begin[n]), end(begin);
      for (std::size_t i = 0; i < couples.size(); i += 2)
        {
          neighbours[end[couples[i]]++]     = couples[i + 1];
          neighbours[end[couples[i + 1]]++] = couples[i];
        }

      std::vector<idx_t> order(n), position(n);
      idx_t              options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED] = 1;
      // Five in place of two: twice the time, some 5 % fewer operations.
      options[METIS_OPTION_NSEPS] = n < costly_from ? 2 : 5;
      if (METIS_NodeND(&n,
                       begin.data(),
                       neighbours.data(),
                       weights.data(),
                       options,
                       order.data(),
                       position.data()) != METIS_OK)
        return {};

      std::vector<int> positions(layout.n_dofs());
      int              next = 1;
      for (const idx_t block : order)
        for (unsigned int i = 0; i < layout.size(block); ++i)
          positions[layout.first_dof(block) + i] = next++;
      return positions;
    }



    /**
     * Position of each dof in the pivot order (from one), on rank 0, from the
     * graph of blocks, which is 80 times smaller than that of dofs. Throws
     * StageFailure, on all ranks, if there is no order.
     */
    std::vector<int>
    pivot_positions(const BlockLayout &layout, const Couplings &blocks)
    {
      using namespace dealii::Utilities::MPI;
      std::vector<idx_t> couples; // of rows and columns
      for (unsigned int row = 0; row < blocks.size(); ++row)
        for (const unsigned int column : blocks[row])
          if (column != layout.owned_blocks()[row])
            {
              couples.push_back(layout.owned_blocks()[row]);
              couples.push_back(column);
            }
      const MPI_Comm comm = layout.communicator();
      // deal.II's gather() would compress them.
      couples = gathered(comm, couples);
      std::vector<int> positions;
      if (this_mpi_process(comm) == 0)
        positions = dissected(layout, couples);
      if (!broadcast(comm, !positions.empty(), 0))
        throw StageFailure("METIS could not order the system of equations");
      return positions;
    }
  } // namespace



  template <typename Mumps, typename Real>
  class DirectFactor::Typed : public DirectFactor::Implementation
  {
  public:
    Typed(const MPI_Comm       comm,
          const Part           part,
          const Entries        entries,
          const RigidSections *sections)
      : comm(comm)
      , part(part)
      , entries(entries)
      , sections(sections)
      , rank(dealii::Utilities::MPI::this_mpi_process(comm))
    {
      data.par          = 1;
      data.sym          = 2;
      data.comm_fortran = MPI_Comm_c2f(comm);
      data.job          = -1;
      call(data);
      for (const unsigned int output : {1, 2, 3})
        control(data, output) = -1;
      control(data, 4)  = 0;  // silent
      control(data, 5)  = 0;  // assembled
      control(data, 7)  = 1;  // ordering given
      control(data, 8)  = 0;  // no scaling: it changes nothing without pivoting
      control(data, 12) = 1;  // no compression of the graph
      control(data, 13) = 1;  // no parallel root: pivot signs are counted
      control(data, 14) = 40; // memory margin [%]
      control(data, 15) = 1;  // the analysis is one of blocks
      control(data, 18) = 3;  // distributed entries
      control(data, 28) = 1;  // sequential analysis
      data.cntl[0]      = 0;  // no numerical pivoting
      control(data, 36) = 1;  // low-rank blocks compressed before solved for
    }

    ~Typed() override
    {
      data.job = -2;
      call(data);
    }

    void
    analyse(const BlockMatrix &matrix) override
    {
      auto needed = couplings_in(matrix, part, entries);
      if (covers(comm, couplings, needed) && is_lean(comm, couplings, needed))
        return;
      couplings.resize(needed.size());
      if (auto both = merged(couplings, needed); is_lean(comm, both, needed))
        couplings = std::move(both);
      else
        couplings = std::move(needed);
      const BlockLayout &layout = factorised(matrix);
      set_pattern(layout);
      if (has_ordering)
        {
          analyse_ordered();
          has_ordering = data.rinfog[0] <= largest_growth * ordered_operations;
        }
      if (!has_ordering)
        {
          positions = pivot_positions(layout, couplings);
          analyse_ordered();
          ordered_operations = data.rinfog[0];
          has_ordering       = true;
        }
    }

    void
    forget() override
    {
      couplings.clear();
      has_ordering = false;
    }

    int
    factorize(const BlockMatrix &matrix, const double dropped) override
    {
      if (sections)
        control(data, 35) = dropped > 0 ? 2 : 0;
      data.cntl[6] = dropped;
      fill_values(matrix);

      data.a_loc = values.data();
      for (unsigned int attempt = 0; attempt < 5; ++attempt)
        {
          data.job = 2;
          call(data);
          if (data.infog[0] >= 0)
            return data.infog[11];
          if (data.infog[0] == -10)
            return -1;
          if (data.infog[0] != -8 && data.infog[0] != -9 &&
              data.infog[0] != -17 && data.infog[0] != -20)
            break;
          control(data, 14) *= 2;
        }
      throw StageFailure("the factorisation failed: MUMPS reports error " +
                         std::to_string(data.infog[0]) +
                         (data.infog[0] == -13 ? " (out of memory)" : ""));
    }

    void
    solve(const BlockLayout &layout, double *owned_values) override
    {
      const int  n_owned = layout.n_owned_dofs();
      const auto counts  = dealii::Utilities::MPI::gather(comm, n_owned, 0);
      const std::vector<int> begins = begins_of(counts);

      std::vector<double> all(rank == 0 ? layout.n_dofs() : 0);
      MPI_Gatherv(owned_values,
                  n_owned,
                  MPI_DOUBLE,
                  all.data(),
                  counts.data(),
                  begins.data(),
                  MPI_DOUBLE,
                  0,
                  comm);
      right_hand_side.resize(all.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        right_hand_side[dof_order[i]] = all[i];

      data.rhs  = right_hand_side.data();
      data.nrhs = 1;
      data.lrhs = layout.n_dofs();
      data.job  = 3;
      call(data);
      if (data.infog[0] < 0)
        throw StageFailure("the solution with the factor failed: MUMPS "
                           "reports error " +
                           std::to_string(data.infog[0]));

      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = right_hand_side[dof_order[i]];
      MPI_Scatterv(all.data(),
                   counts.data(),
                   begins.data(),
                   MPI_DOUBLE,
                   owned_values,
                   n_owned,
                   MPI_DOUBLE,
                   0,
                   comm);
    }

  private:
    /** The layout of what is factorised. */
    const BlockLayout &
    factorised(const BlockMatrix &matrix) const
    {
      return sections ? sections->layout() : matrix.layout();
    }

    /** The entries of the upper triangle, in the order of fill_values(). */
    void
    set_pattern(const BlockLayout &layout)
    {
      rows.clear();
      columns.clear();
      for (unsigned int row = 0; row < couplings.size(); ++row)
        {
          const unsigned int block     = layout.owned_blocks()[row];
          const unsigned int first_row = layout.first_dof(block) + 1;
          for (const unsigned int column : couplings[row])
            {
              const unsigned int first_column = layout.first_dof(column) + 1;
              for (unsigned int i = 0; i < layout.size(block); ++i)
                for (unsigned int j = column == block ? i : 0;
                     j < layout.size(column);
                     ++j)
                  {
                    rows.push_back(first_row + i);
                    columns.push_back(first_column + j);
                  }
            }
        }

      block_begins.clear();
      for (unsigned int block = 0; block <= layout.n_blocks(); ++block)
        block_begins.push_back(layout.first_dof(block) + 1);

      // The order in which owned dofs arrive on rank 0.
      std::vector<dealii::types::global_dof_index> mine;
      layout.owned_dofs().fill_index_vector(mine);
      const auto owned = dealii::Utilities::MPI::gather(comm, mine, 0);
      dof_order.clear();
      for (const auto &part : owned)
        dof_order.insert(dof_order.end(), part.begin(), part.end());

      data.n       = layout.n_dofs();
      data.nnz_loc = rows.size();
      data.irn_loc = rows.data();
      data.jcn_loc = columns.data();
      data.nblk    = layout.n_blocks();
      data.blkptr  = block_begins.data();
    }

    void
    analyse_ordered()
    {
      if (sections)
        control(data, 35) = 2; // low-rank blocks; 0 here forbids them later
      data.perm_in = positions.data();
      data.job     = 1;
      call(data);
      if (data.infog[0] < 0)
        throw StageFailure("the analysis of the system of equations failed: "
                           "MUMPS reports error " +
                           std::to_string(data.infog[0]));
    }

    /** Of the symmetric part; only within a diagonal block there can be
     * another. Blocks that the matrix has not are zero. */
    void
    fill_values(const BlockMatrix &matrix)
    {
      const BlockLayout &layout = factorised(matrix);
      values.clear();
      values.reserve(rows.size());
      for (unsigned int row = 0; row < couplings.size(); ++row)
        {
          const unsigned int block   = layout.owned_blocks()[row];
          const unsigned int height  = layout.size(block);
          const auto        &present = matrix.columns(row);
          auto               next    = present.begin();
          for (const unsigned int column : couplings[row])
            {
              const unsigned int width = layout.size(column);
              next = std::lower_bound(next, present.end(), column);
              const double *entries =
                next != present.end() && *next == column ?
                  matrix.values(row, next - present.begin()) :
                  nullptr;
              if (entries && sections)
                entries = sections->reduce(block, column, entries);
              if (column != block)
                for (unsigned int i = 0; i < height * width; ++i)
                  values.push_back(entries ? entries[i] : 0);
              else
                for (unsigned int i = 0; i < height; ++i)
                  for (unsigned int j = i; j < height; ++j)
                    values.push_back(is_in(part, layout, block) ?
                                       .5 * (entries[i * height + j] +
                                             entries[j * height + i]) :
                                       i == j);
            }
        }
    }

    MPI_Comm                                     comm;
    const Part                                   part;
    const Entries                                entries;
    const RigidSections                         *sections; // or null
    unsigned int                                 rank;
    Mumps                                        data{};
    Couplings                                    couplings; // analysed
    bool                                         has_ordering       = false;
    double                                       ordered_operations = 0;
    std::vector<int>                             rows, columns, positions;
    std::vector<int>                             block_begins;
    std::vector<Real>                            values, right_hand_side;
    std::vector<dealii::types::global_dof_index> dof_order;
  };



  DirectFactor::DirectFactor(const MPI_Comm       comm,
                             const Precision      precision,
                             const Part           part,
                             const Entries        entries,
                             const RigidSections *sections)
  {
    if (precision == Precision::double_precision)
      implementation = std::make_unique<Typed<DMUMPS_STRUC_C, double>>(
        comm, part, entries, sections);
    else
      implementation = std::make_unique<Typed<SMUMPS_STRUC_C, float>>(comm,
                                                                      part,
                                                                      entries,
                                                                      sections);
  }



  DirectFactor::~DirectFactor() = default;



  void
  DirectFactor::analyse(const BlockMatrix &matrix)
  {
    implementation->analyse(matrix);
  }



  void
  DirectFactor::forget()
  {
    implementation->forget();
  }



  int
  DirectFactor::factorize(const BlockMatrix &matrix, const double dropped)
  {
    return implementation->factorize(matrix, dropped);
  }



  void
  DirectFactor::solve(const BlockLayout &layout, double *owned_values)
  {
    implementation->solve(layout, owned_values);
  }
} // namespace fiberloom
