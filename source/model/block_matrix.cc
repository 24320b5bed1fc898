// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/model/block_matrix.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <utility>

namespace fiberloom
{
  namespace
  {
    // Blocks that are not needed any more cost less than a new analysis, up to
    // this part of those that are.
    constexpr double largest_surplus = .05;
  } // namespace



  BlockMatrix::BlockMatrix(const BlockLayout &layout,
                           const double       lever,
                           const double       matrix_weight)
    : numbering(layout)
    , lever(lever)
    , matrix_weight(matrix_weight)
    , owned_map(
        layout.owned_dofs().make_trilinos_map(layout.communicator(), false))
  {}



  std::size_t
  BlockMatrix::n_exchanged() const
  {
    const std::size_t own = importer ? importer->NumRemoteIDs() : 0;
    return dealii::Utilities::MPI::sum(own, numbering.communicator());
  }



  void
  BlockMatrix::reinit(std::vector<std::vector<unsigned int>> columns)
  {
    if (covers(columns))
      return set_zero();
    ++version;
    column_blocks = std::move(columns);

    std::vector<unsigned int> needed;
    std::size_t               size = 0;
    offsets.resize(column_blocks.size());
    for (unsigned int row = 0; row < column_blocks.size(); ++row)
      {
        const unsigned int height =
          numbering.size(numbering.owned_blocks()[row]);
        offsets[row].clear();
        for (const unsigned int column : column_blocks[row])
          {
            offsets[row].push_back(size);
            size += height * numbering.size(column);
          }
        needed.insert(needed.end(),
                      column_blocks[row].begin(),
                      column_blocks[row].end());
      }
    data.assign(size, 0.);
    added = 0;

    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    std::vector<int> dofs;
    position_of_block.assign(numbering.n_blocks(), 0);
    for (const unsigned int block : needed)
      {
        position_of_block[block] = dofs.size();
        for (unsigned int i = 0; i < numbering.size(block); ++i)
          dofs.push_back(numbering.first_dof(block) + i);
      }
    column_map = std::make_unique<Epetra_Map>(
      -1, static_cast<int>(dofs.size()), dofs.data(), 0, owned_map.Comm());
    importer = std::make_unique<Epetra_Import>(*column_map, owned_map);

    column_positions.resize(column_blocks.size());
    for (unsigned int row = 0; row < column_blocks.size(); ++row)
      {
        column_positions[row].clear();
        for (const unsigned int column : column_blocks[row])
          column_positions[row].push_back(position_of_block[column]);
      }
  }



  bool
  BlockMatrix::covers(
    const std::vector<std::vector<unsigned int>> &columns) const
  {
    bool        covered = version > 0;
    std::size_t present = 0, needed = 0;
    for (unsigned int row = 0; row < columns.size() && covered; ++row)
      {
        covered = std::includes(column_blocks[row].begin(),
                                column_blocks[row].end(),
                                columns[row].begin(),
                                columns[row].end());
        present += column_blocks[row].size();
        needed += columns[row].size();
      }
    covered = covered && present <= (1 + largest_surplus) * needed;
    return dealii::Utilities::MPI::min(int(covered),
                                       numbering.communicator()) == 1;
  }



  void
  BlockMatrix::set_zero()
  {
    std::fill(data.begin(), data.end(), 0.);
    added = 0;
  }



  void
  BlockMatrix::add_to_diagonal(const double value)
  {
    added += value;
    for (const unsigned int row : numbering.owned_blocks())
      {
        const unsigned int n       = numbering.size(row);
        double            *entries = block(row, row);
        for (unsigned int i = 0; i < n; ++i)
          entries[i * n + i] += n == 6 && i >= 3 ? value * lever * lever :
                                n == 3           ? value * matrix_weight :
                                                   value;
      }
  }



  void
  BlockMatrix::add_to_diagonal(const std::vector<double> &values)
  {
    for (const unsigned int row : numbering.owned_blocks())
      if (row < values.size())
        {
          const unsigned int n       = numbering.size(row);
          double            *entries = block(row, row);
          for (unsigned int i = 0; i < n; ++i)
            entries[i * n + i] += values[row];
        }
  }



  std::vector<double>
  BlockMatrix::times(const std::vector<double> &x) const
  {
    std::vector<double> y(x.size());
    const Epetra_Vector in(View,
                           OperatorDomainMap(),
                           const_cast<double *>(x.data()));
    Epetra_Vector       out(View, OperatorRangeMap(), y.data());
    Apply(in, out);
    return y;
  }



  void
  BlockMatrix::isolate(const std::vector<char> &kept, const double diagonal)
  {
    for (unsigned int row = 0; row < column_blocks.size(); ++row)
      {
        const unsigned int block  = numbering.owned_blocks()[row];
        const unsigned int height = numbering.size(block);
        for (unsigned int c = 0; c < column_blocks[row].size(); ++c)
          if (const unsigned int column = column_blocks[row][c];
              !kept[block] || !kept[column])
            {
              double *entries = values(row, c);
              std::fill_n(entries, height * numbering.size(column), 0.);
              for (unsigned int i = 0; block == column && i < height; ++i)
                entries[i * height + i] = diagonal;
            }
      }
  }



  double
  BlockMatrix::least_addition() const
  {
    return std::min(1., matrix_weight) * added;
  }



  double *
  BlockMatrix::block(const unsigned int row, const unsigned int column)
  {
    return const_cast<double *>(std::as_const(*this).block(row, column));
  }



  const double *
  BlockMatrix::block(const unsigned int row, const unsigned int column) const
  {
    const unsigned int local_row = numbering.local_block(row);
    const auto        &columns   = column_blocks[local_row];
    const auto found = std::lower_bound(columns.begin(), columns.end(), column);
    Assert(found != columns.end() && *found == column,
           dealii::ExcMessage("block outside the pattern"));
    return data.data() + offsets[local_row][found - columns.begin()];
  }



  void
  BlockMatrix::add_outer_product(const std::vector<unsigned int> &blocks,
                                 const Eigen::VectorXd           &row,
                                 const Eigen::VectorXd           &column)
  {
    OuterProduct product{{}, {}, row, column};
    unsigned int offset = 0;
    for (const unsigned int block : blocks)
      {
        const unsigned int size = numbering.size(block);
        if (const int local = numbering.local_block(block); local >= 0)
          product.rows.push_back(
            {{numbering.local_first_dof(local), offset, size}});
        product.columns.push_back({{position_of_block[block], offset, size}});
        offset += size;
      }
    outer_products.push_back(std::move(product));
  }



  void
  BlockMatrix::remove_outer_products()
  {
    outer_products.clear();
  }



  template <int height>
  void
  BlockMatrix::multiply_row(const unsigned int row,
                            const double      *in,
                            double            *out) const
  {
    // Of a size that is known, sums stay in registers.
    constexpr int largest = 9;
    using Sum             = Eigen::Matrix<double, height, 1, 0, largest, 1>;
    Eigen::Map<Sum> result(out, numbering.size(numbering.owned_blocks()[row]));
    Sum             sum = Sum::Zero(result.size());
    for (unsigned int c = 0; c < column_blocks[row].size(); ++c)
      {
        const unsigned int width   = numbering.size(column_blocks[row][c]);
        const double      *entries = values(row, c);
        const double      *x       = in + column_positions[row][c];
        if (height == 9 && width == 9)
          sum +=
            Eigen::Map<const Eigen::Matrix<double, 9, 9, Eigen::RowMajor>>(
              entries)
              .lazyProduct(Eigen::Map<const Eigen::Matrix<double, 9, 1>>(x));
        else
          for (unsigned int i = 0; i < sum.size(); ++i)
            for (unsigned int j = 0; j < width; ++j)
              sum[i] += entries[i * width + j] * x[j];
      }
    result = sum;
  }



  int
  BlockMatrix::Apply(const Epetra_MultiVector &x, Epetra_MultiVector &y) const
  {
    Epetra_MultiVector imported(*column_map, x.NumVectors(), false);
    const int          error = imported.Import(x, *importer, Insert);
    if (error != 0)
      return error;

    for (int v = 0; v < x.NumVectors(); ++v)
      for (unsigned int row = 0; row < column_blocks.size(); ++row)
        {
          double            *out = y[v] + numbering.local_first_dof(row);
          const unsigned int height =
            numbering.size(numbering.owned_blocks()[row]);
          if (height == 9)
            multiply_row<9>(row, imported[v], out);
          else
            multiply_row<Eigen::Dynamic>(row, imported[v], out);
        }
    if (outer_products_used)
      for (int v = 0; v < x.NumVectors(); ++v)
        for (const OuterProduct &product : outer_products)
          {
            double factor = 0;
            for (const auto &[where, offset, size] : product.columns)
              factor +=
                Eigen::Map<const Eigen::VectorXd>(imported[v] + where, size)
                  .dot(product.column.segment(offset, size));
            for (const auto &[where, offset, size] : product.rows)
              Eigen::Map<Eigen::VectorXd>(y[v] + where, size) +=
                factor * product.row.segment(offset, size);
          }
    return 0;
  }
} // namespace fiberloom
