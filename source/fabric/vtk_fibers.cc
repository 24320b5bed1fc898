// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>

#include <fiberloom/fabric/units.h>
#include <fiberloom/fabric/vtk_arrays.h>
#include <fiberloom/fabric/vtk_fibers.h>
#include <fiberloom/fabric/xml_scanner.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

namespace fiberloom
{
  namespace
  {
    /** A piece as it stands in the file. */
    struct Piece
    {
      std::map<std::string, std::string>           counts; // by attribute
      std::map<std::string, std::vector<VtkArray>> arrays; // by element
    };

    /** The elements of a file of VTK, whose arrays are not read yet. */
    class VtkFile
    {
    public:
      std::vector<Piece> pieces;
      VtkEncoding        encoding;

      /** @p kind is PolyData or UnstructuredGrid. */
      VtkFile(const std::string_view content, const std::string &kind)
        : kind(kind)
        , scanner(content)
      {
        using Kind = XmlScanner::Piece;
        for (Kind piece = scanner.next(); piece != Kind::end;
             piece      = scanner.next())
          if (piece == Kind::opening && scanner.name() == "AppendedData")
            {
                   open_appended_data();
                   break; // it is no XML
            }
          else if (piece == Kind::opening)
            open();
          else if (piece == Kind::closing)
            array = is_array(scanner.name()) ? nullptr : array;
          else if (array != nullptr && is_array(scanner.open_elements().back()))
            add_text();
        if (!is_of_kind)
          scanner.fail("there is no element VTKFile of type " + kind);
      }

    private:
      const std::string kind;
      XmlScanner        scanner;
      bool              is_of_kind = false;
      VtkArray         *array      = nullptr; // the one that is open

      static bool
      is_array(const std::string &name)
      {
        return name == "DataArray" || name == "Array";
      }

      /** VTKFile/PolyData/Piece/Lines/DataArray, and what is beside it. */
      void
      open()
      {
        const auto       &path  = scanner.open_elements();
        const std::string name  = scanner.name();
        const std::size_t depth = path.size();
        if (depth == 1)
          open_file();
        else if (depth == 3 && name == "Piece" && path[1] == kind)
          open_piece();
        else if (depth == 5 && is_array(name) && path[2] == "Piece" &&
                 !pieces.empty())
          open_array(pieces.back().arrays[path[3]]);
      }

      void
      open_file()
      {
        is_of_kind =
          scanner.name() == "VTKFile" && scanner.attribute("type", "") == kind;
        encoding.big_endian =
          scanner.attribute("byte_order", "LittleEndian") == "BigEndian";
        encoding.wide_header =
          scanner.attribute("header_type", "UInt32") == "UInt64";
        encoding.compressor = scanner.attribute("compressor", "");
        if (!is_of_kind)
          scanner.fail("there is no element VTKFile of type " + kind);
      }

      void
      open_piece()
      {
        pieces.emplace_back();
        for (const char *name : {"NumberOfPoints",
                                 "NumberOfCells",
                                 "NumberOfVerts",
                                 "NumberOfLines",
                                 "NumberOfStrips",
                                 "NumberOfPolys"})
          pieces.back().counts[name] = scanner.attribute(name, "0");
      }

      void
      open_array(std::vector<VtkArray> &arrays)
      {
        arrays.push_back({scanner.attribute("type", "of none"),
                          scanner.attribute("Name", ""),
                          scanner.attribute("NumberOfComponents", "1"),
                          scanner.attribute("format", "ascii"),
                          scanner.attribute("offset", ""),
                          {}});
        array = &arrays.back();
      }

      void
      add_text()
      {
        if (!array->text.empty())
          scanner.fail("array " + array->name + " stands in two parts");
        array->text = scanner.text();
      }

      void
      open_appended_data()
      {
        if (scanner.attribute("encoding", "base64") == "base64")
          encoding.appended_code = ByteCode::base64;
        encoding.appended      = scanner.rest();
        const std::size_t mark = encoding.appended.find('_');
        if (mark == std::string_view::npos)
          scanner.fail("there is no _ before the appended data");
        encoding.appended.remove_prefix(mark + 1);
      }
    };

    /** The fibers of a piece. */
    class PieceReader
    {
    public:
      PieceReader(const Piece       &piece,
                  const VtkEncoding &encoding,
                  FiberFile         &file)
        : piece(piece)
        , encoding(encoding)
        , file(file)
        , n_points(count("NumberOfPoints"))
      {}

      void
      read_poly_data()
      {
        for (const char *other :
             {"NumberOfVerts", "NumberOfStrips", "NumberOfPolys"})
          if (count(other) > 0)
            throw InputError(
              "has cells that are no lines, " + std::string(other) + " = " +
              std::to_string(count(other)) + "; allowed: lines and polylines");
        n_cells = count("NumberOfLines");
        if (n_cells > 0)
          read_fibers("Lines");
      }

      void
      read_unstructured_grid()
      {
        n_cells = count("NumberOfCells");
        if (n_cells == 0)
          return;
        check_types();
        read_fibers("Cells");
      }

    private:
      const Piece       &piece;
      const VtkEncoding &encoding;
      FiberFile         &file;
      const std::size_t  n_points;
      std::size_t        n_cells = 0;

      // Numbers of points, those of cell c ending before ends[c].
      std::vector<std::size_t> connectivity, ends;
      std::size_t              first_fiber = 0;

      /** Those that the element @p cells says. */
      void
      read_fibers(const std::string &cells)
      {
        read_cells(cells);
        read_points();
        for (std::size_t v = 0; v < FiberPoints::value_names.size(); ++v)
          read_values(v);
      }

      std::size_t
      count(const std::string &name) const
      {
        return read_count(piece.counts.at(name), name, FiberFile::most_points);
      }

      const std::vector<VtkArray> &
      arrays(const std::string &element) const
      {
        static const std::vector<VtkArray> none;
        const auto                         found = piece.arrays.find(element);
        return found == piece.arrays.end() ? none : found->second;
      }

      /** @p least to @p most , each a whole number. */
      std::vector<std::size_t>
      read_numbers(const std::string &element,
                   const std::string &name,
                   const std::size_t  n,
                   const std::size_t  most) const
      {
        const VtkArray *found = nullptr;
        for (const VtkArray &array : arrays(element))
          if (array.name == name && found != nullptr)
            throw InputError("has two arrays " + name + "; allowed: one");
          else if (array.name == name)
            found = &array;
        if (found == nullptr)
          throw InputError("has no array " + name + " of cells");
        std::vector<std::size_t> numbers;
        for (const double number :
             read_array(*found, encoding, n, Numbers::whole))
          {
            if (!(number >= 0 && number <= most) ||
                number != static_cast<double>(static_cast<std::size_t>(number)))
              throw InputError(
                "array " + name + ": number " + std::to_string(numbers.size()) +
                " is out of range; allowed: from 0 to " + std::to_string(most));
            numbers.push_back(number);
          }
        return numbers;
      }

      void
      check_types() const
      {
        constexpr std::size_t line = 3, polyline = 4; // of VTK's list
        const auto types = read_numbers("Cells", "types", n_cells, 255);
        for (std::size_t c = 0; c < n_cells; ++c)
          if (types[c] != line && types[c] != polyline)
            throw InputError(
              "cell " + std::to_string(c) + " is no line but of type " +
              std::to_string(types[c]) + "; allowed: lines and polylines");
      }

      void
      read_cells(const std::string &element)
      {
        ends =
          read_numbers(element, "offsets", n_cells, FiberFile::most_points);
        for (std::size_t c = 0; c < n_cells; ++c)
          if (const std::size_t begin = c == 0 ? 0 : ends[c - 1];
              ends[c] < begin + 2)
            throw InputError("array offsets: cell " + std::to_string(c) +
                             " goes from " + std::to_string(begin) + " to " +
                             std::to_string(ends[c]) +
                             "; allowed: two points or more");
        if (n_points == 0)
          throw InputError("has no points; allowed: two or more");
        connectivity =
          read_numbers(element, "connectivity", ends.back(), n_points - 1);
      }

      std::size_t
      begin_of(const std::size_t cell) const
      {
        return cell == 0 ? 0 : ends[cell - 1];
      }

      void
      read_points()
      {
        const auto &found = arrays("Points");
        if (found.size() != 1 || found[0].n_components != "3")
          throw InputError("has no points of three coordinates; allowed: one "
                           "array of them");
        const auto x =
          read_array(found[0], encoding, 3 * n_points, Numbers::any);
        first_fiber = file.fibers.size();
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            FiberPoints fiber;
            for (std::size_t i = begin_of(c); i < ends[c]; ++i)
              fiber.points.emplace_back(x[3 * connectivity[i]],
                                        x[3 * connectivity[i] + 1],
                                        x[3 * connectivity[i] + 2]);
            file.fibers.push_back(std::move(fiber));
          }
      }

      /** Of the value number @p v in arrays of cells or of points. */
      void
      read_values(const std::size_t v)
      {
        const std::string name  = FiberPoints::value_names[v];
        bool              found = false;
        for (const char *element : {"CellData", "PointData"})
          for (const VtkArray &array : arrays(element))
            {
              const Heading heading = read_heading(array.name);
              if (heading.name != name)
                continue;
              if (found)
                throw InputError("has two arrays " + name + "; allowed: one");
              found = true;
              if (array.n_components != "1")
                throw InputError("array " + name + " has " +
                                 array.n_components +
                                 " components; allowed: 1");
              if (element == std::string("CellData"))
                set_values_of_cells(v, array, heading.factor);
              else
                set_values_of_points(v, array, heading.factor);
            }
      }

      void
      set_values_of_cells(const std::size_t v,
                          const VtkArray   &array,
                          const double      factor)
      {
        const auto values = read_array(array, encoding, n_cells, Numbers::any);
        for (std::size_t c = 0; c < n_cells; ++c)
          file.fibers[first_fiber + c].values[v] = factor * values[c];
      }

      void
      set_values_of_points(const std::size_t v,
                           const VtkArray   &array,
                           const double      factor)
      {
        const auto values = read_array(array, encoding, n_points, Numbers::any);
        for (std::size_t c = 0; c < n_cells; ++c)
          {
            const double value = values[connectivity[begin_of(c)]];
            for (std::size_t i = begin_of(c); i < ends[c]; ++i)
              if (values[connectivity[i]] != value)
                throw InputError("fiber " + std::to_string(first_fiber + c) +
                                 ": " + FiberPoints::value_names[v] +
                                 " changes along it; allowed: one value a "
                                 "fiber");
            file.fibers[first_fiber + c].values[v] = factor * value;
          }
      }
    };

    /** Names of arrays that are not read. */
    std::vector<std::string>
    ignored_arrays(const std::vector<Piece> &pieces)
    {
      std::vector<std::string> names;
      for (const Piece &piece : pieces)
        for (const auto &[element, arrays] : piece.arrays)
          for (const VtkArray &array : arrays)
            if ((element == "CellData" || element == "PointData") &&
                std::count(FiberPoints::value_names.begin(),
                           FiberPoints::value_names.end(),
                           read_heading(array.name).name) == 0 &&
                std::count(names.begin(), names.end(), array.name) == 0)
              names.push_back(array.name);
      return names;
    }
  } // namespace



  FiberFile
  read_vtk_fibers(const std::string &file)
  {
    const bool is_poly_data = std::filesystem::path(file).extension() == ".vtp";
    const std::string content = read_input_file(file, FiberFile::most_bytes);
    std::optional<VtkFile> vtk;
    try
      {
        vtk.emplace(content, is_poly_data ? "PolyData" : "UnstructuredGrid");
      }
    catch (const InputError &error)
      {
        throw InputError("is damaged, or no XML file of VTK: " +
                         std::string(error.what()));
      }
    FiberFile found;
    for (const Piece &piece : vtk->pieces)
      {
        PieceReader reader(piece, vtk->encoding, found);
        if (is_poly_data)
          reader.read_poly_data();
        else
          reader.read_unstructured_grid();
      }
    found.ignored = ignored_arrays(vtk->pieces);
    for (const std::string name : FiberPoints::value_names)
      found.read += (found.read.empty() ? "" : ", ") + name;
    return found;
  }
} // namespace fiberloom
