// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/solvers/direct_factor.h>

#include <deal.II/base/mpi.h>

#include <dmumps_c.h>
#include <metis.h>
#include <smumps_c.h>

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
    forget_ordering() = 0;

    virtual int
    factorize(const BlockMatrix &matrix) = 0;

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

    // Operations of a factor with an ordering of an earlier pattern, over those
    // when it was new.
    constexpr double largest_growth = 1.05;

    /**
     * Position of each dof in the pivot order (from one), on rank 0; METIS's
     * nested dissection on the graph of blocks, which is 80 times smaller
     * than that of dofs.
     */
    std::vector<int>
    pivot_positions(const BlockMatrix &matrix, const DirectFactor::Part part)
    {
      const BlockLayout &layout = matrix.layout();
      const auto        &owned  = layout.owned_blocks();

      std::vector<unsigned int> local; // block, count, neighbours ...
      for (unsigned int row = 0; row < owned.size(); ++row)
        {
          local.push_back(owned[row]);
          const std::size_t count = local.size();
          local.push_back(0);
          if (is_in(part, layout, owned[row]))
            for (const unsigned int column : matrix.columns(row))
              if (column != owned[row] && is_in(part, layout, column))
                {
                  local.push_back(column);
                  ++local[count];
                }
        }
      const auto parts =
        dealii::Utilities::MPI::gather(layout.communicator(), local, 0);
      if (dealii::Utilities::MPI::this_mpi_process(layout.communicator()) != 0)
        return {};

      idx_t              n = layout.n_blocks();
      std::vector<idx_t> begin(n + 1, 0), neighbours, weights(n);
      for (idx_t block = 0; block < n; ++block)
        weights[block] = layout.size(block);
      for (const auto &part : parts)
        for (std::size_t i = 0; i < part.size(); i += 2 + part[i + 1])
          begin[part[i] + 1] = part[i + 1];
      for (idx_t block = 0; block < n; ++block)
        begin[block + 1] += begin[block];
      neighbours.resize(begin[n]);
      for (const auto &part : parts)
        for (std::size_t i = 0; i < part.size(); i += 2 + part[i + 1])
          std::copy(part.begin() + i + 2,
                    part.begin() + i + 2 + part[i + 1],
                    neighbours.begin() + begin[part[i]]);

      std::vector<idx_t> order(n), position(n);
      idx_t              options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED]  = 1;
      options[METIS_OPTION_NSEPS] = 5; // 5 % fewer operations than with one
      if (METIS_NodeND(&n,
                       begin.data(),
                       neighbours.data(),
                       weights.data(),
                       options,
                       order.data(),
                       position.data()) != METIS_OK)
        throw StageFailure("METIS could not order the system of equations");

      std::vector<int> positions(layout.n_dofs());
      int              next = 1;
      for (const idx_t block : order)
        for (unsigned int i = 0; i < layout.size(block); ++i)
          positions[layout.first_dof(block) + i] = next++;
      return positions;
    }
  } // namespace



  template <typename Mumps, typename Real>
  class DirectFactor::Typed : public DirectFactor::Implementation
  {
  public:
    Typed(const MPI_Comm comm, const Part part)
      : comm(comm)
      , part(part)
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
      control(data, 12) = 1;  // no compression of the graph
      control(data, 13) = 1;  // no parallel root: pivot signs are counted
      control(data, 14) = 40; // memory margin [%]
      control(data, 15) = 1;  // the analysis is one of blocks
      control(data, 18) = 3;  // distributed entries
      control(data, 28) = 1;  // sequential analysis
      data.cntl[0]      = 0;  // no numerical pivoting
    }

    ~Typed() override
    {
      data.job = -2;
      call(data);
    }

    void
    analyse(const BlockMatrix &matrix) override
    {
      if (analysed == matrix.pattern_version() && &matrix == analysed_matrix)
        return;
      set_pattern(matrix);
      has_ordering = has_ordering && &matrix == analysed_matrix;
      if (has_ordering)
        {
          analyse_ordered();
          has_ordering = data.rinfog[0] <= largest_growth * operations;
        }
      if (!has_ordering)
        {
          positions = pivot_positions(matrix, part);
          analyse_ordered();
          operations   = data.rinfog[0];
          has_ordering = true;
        }
      analysed        = matrix.pattern_version();
      analysed_matrix = &matrix;
    }

    void
    forget_ordering() override
    {
      has_ordering = false;
    }

    int
    factorize(const BlockMatrix &matrix) override
    {
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
      const auto &owned = layout.owned_dofs();
      const auto  counts =
        dealii::Utilities::MPI::gather(comm,
                                       static_cast<int>(owned.n_elements()),
                                       0);
      std::vector<int> begins(counts.size(), 0);
      for (unsigned int r = 1; r < counts.size(); ++r)
        begins[r] = begins[r - 1] + counts[r - 1];

      std::vector<double> all(rank == 0 ? layout.n_dofs() : 0);
      MPI_Gatherv(owned_values,
                  owned.n_elements(),
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
                   owned.n_elements(),
                   MPI_DOUBLE,
                   0,
                   comm);
    }

  private:
    /**
     * Calls @p visit(row dof, column dof, value) for the owned upper triangle
     * of the symmetric part; only within a diagonal block there can be another.
     */
    template <class Visit>
    void
    visit_upper_triangle(const BlockMatrix &matrix, const Visit &visit) const
    {
      const BlockLayout &layout = matrix.layout();
      for (unsigned int row = 0; row < layout.owned_blocks().size(); ++row)
        {
          const unsigned int block   = layout.owned_blocks()[row];
          const unsigned int row_dof = layout.first_dof(block);
          const auto        &columns = matrix.columns(row);
          if (!is_in(part, layout, block))
            {
              for (unsigned int i = 0; i < layout.size(block); ++i)
                visit(row_dof + i, row_dof + i, 1);
              continue;
            }
          for (unsigned int c = 0; c < columns.size(); ++c)
            {
              if (columns[c] < block || !is_in(part, layout, columns[c]))
                continue;
              const unsigned int column_dof = layout.first_dof(columns[c]);
              const unsigned int width      = layout.size(columns[c]);
              const double      *entries    = matrix.values(row, c);
              for (unsigned int i = 0; i < layout.size(block); ++i)
                for (unsigned int j = columns[c] == block ? i : 0; j < width;
                     ++j)
                  visit(row_dof + i,
                        column_dof + j,
                        columns[c] == block ? .5 * (entries[i * width + j] +
                                                    entries[j * width + i]) :
                                              entries[i * width + j]);
            }
        }
    }

    void
    set_pattern(const BlockMatrix &matrix)
    {
      rows.clear();
      columns.clear();
      visit_upper_triangle(matrix,
                           [&](const unsigned int row,
                               const unsigned int column,
                               const double) {
                             rows.push_back(row + 1);
                             columns.push_back(column + 1);
                           });

      const BlockLayout &layout = matrix.layout();
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
      data.perm_in = positions.data();
      data.job     = 1;
      call(data);
      if (data.infog[0] < 0)
        throw StageFailure("the analysis of the system of equations failed: "
                           "MUMPS reports error " +
                           std::to_string(data.infog[0]));
    }

    void
    fill_values(const BlockMatrix &matrix)
    {
      values.clear();
      values.reserve(rows.size());
      visit_upper_triangle(matrix,
                           [&](const unsigned int,
                               const unsigned int,
                               const double value) {
                             values.push_back(value);
                           });
    }

    MPI_Comm                                     comm;
    const Part                                   part;
    unsigned int                                 rank;
    Mumps                                        data{};
    unsigned int                                 analysed        = 0;
    bool                                         has_ordering    = false;
    double                                       operations      = 0;
    const BlockMatrix                           *analysed_matrix = nullptr;
    std::vector<int>                             rows, columns, positions;
    std::vector<int>                             block_begins;
    std::vector<Real>                            values, right_hand_side;
    std::vector<dealii::types::global_dof_index> dof_order;
  };



  DirectFactor::DirectFactor(const MPI_Comm  comm,
                             const Precision precision,
                             const Part      part)
  {
    if (precision == Precision::double_precision)
      implementation =
        std::make_unique<Typed<DMUMPS_STRUC_C, double>>(comm, part);
    else
      implementation =
        std::make_unique<Typed<SMUMPS_STRUC_C, float>>(comm, part);
  }



  DirectFactor::~DirectFactor() = default;



  void
  DirectFactor::analyse(const BlockMatrix &matrix)
  {
    implementation->analyse(matrix);
  }



  void
  DirectFactor::forget_ordering()
  {
    implementation->forget_ordering();
  }



  int
  DirectFactor::factorize(const BlockMatrix &matrix)
  {
    return implementation->factorize(matrix);
  }



  void
  DirectFactor::solve(const BlockLayout &layout, double *owned_values)
  {
    implementation->solve(layout, owned_values);
  }
} // namespace fiberloom
