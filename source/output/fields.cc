// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/fields.h>
#include <fiberloom/output/files.h>
#include <fiberloom/output/xml_content.h>

#include <deal.II/base/mpi.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    constexpr double same_time = 1e-9;

    const char *const xml_header = "<?xml version=\"1.0\"?>\n";

    const char *
    xml_type(vtkDataArray *array)
    {
      switch (array->GetDataType())
        {
          case VTK_FLOAT:
            return "Float32";
          case VTK_DOUBLE:
            return "Float64";
          default:
            return "Int32";
        }
    }

    void
    list_array(std::ostream &out, vtkDataArray *array)
    {
      out << "      <PDataArray type=\"" << xml_type(array) << "\" Name=\""
          << (array->GetName() ? array->GetName() : "Points")
          << "\" NumberOfComponents=\"" << array->GetNumberOfComponents()
          << "\"/>\n";
    }

    void
    list_arrays(std::ostream         &out,
                const std::string    &tag,
                vtkDataSetAttributes *data)
    {
      out << "    <" << tag << ">\n";
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
        list_array(out, data->GetArray(i));
      out << "    </" << tag << ">\n";
    }

    std::string
    piece_list(vtkUnstructuredGrid            *piece,
               const std::vector<std::string> &pieces)
    {
      std::ostringstream out;
      out << xml_header
          << "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
          << "  <PUnstructuredGrid GhostLevel=\"0\">\n";
      list_arrays(out, "PPointData", piece->GetPointData());
      list_arrays(out, "PCellData", piece->GetCellData());
      out << "    <PPoints>\n";
      list_array(out, piece->GetPoints()->GetData());
      out << "    </PPoints>\n";
      for (const auto &file : pieces)
        out << "    <Piece Source=\"" << file << "\"/>\n";
      out << "  </PUnstructuredGrid>\n</VTKFile>\n";
      return out.str();
    }
  } // namespace



  FieldSeries::FieldSeries(const std::string &output_directory,
                           const std::string &name,
                           const MPI_Comm     comm)
    : directory(output_directory)
    , name(name)
    , comm(comm)
  {}



  void
  FieldSeries::continue_from(const Entries &former, const double time)
  {
    all_entries.clear();
    for (const auto &entry : former)
      if (entry.first < time + same_time)
        all_entries.push_back(entry);
  }



  bool
  FieldSeries::has(const double time) const
  {
    return std::any_of(all_entries.begin(),
                       all_entries.end(),
                       [time](const auto &entry) {
                         return std::abs(entry.first - time) < same_time;
                       });
  }



  void
  FieldSeries::write(vtkUnstructuredGrid *piece,
                     const double         time,
                     const std::string   &label)
  {
    using namespace dealii::Utilities::MPI;

    const std::string folder     = directory + "/fields/";
    const std::string stem       = name + "_" + label;
    const auto        piece_name = [&](const unsigned int rank) {
      return stem + "_" + std::to_string(rank) + ".vtu";
    };

    collectively(comm, [&]() {
      std::filesystem::create_directories(folder);
      write_file(folder + piece_name(this_mpi_process(comm)),
                 xml_content<vtkXMLUnstructuredGridWriter>(piece));
    });

    all_entries.erase(std::remove_if(all_entries.begin(),
                                     all_entries.end(),
                                     [time](const auto &entry) {
                                       return std::abs(entry.first - time) <
                                              same_time;
                                     }),
                      all_entries.end());
    all_entries.emplace_back(time, "fields/" + stem + ".pvtu");

    collectively(comm, [&]() {
      if (this_mpi_process(comm) != 0)
        return;
      std::vector<std::string> pieces;
      for (unsigned int rank = 0; rank < n_mpi_processes(comm); ++rank)
        pieces.push_back(piece_name(rank));
      write_file(folder + stem + ".pvtu", piece_list(piece, pieces));
      write_file(directory + "/" + name + ".pvd", collection());
    });
  }



  std::string
  FieldSeries::collection() const
  {
    std::ostringstream out;
    out.precision(12);
    out << xml_header
        << "<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const auto &[time, file] : all_entries)
      out << "    <DataSet timestep=\"" << time << "\" file=\"" << file
          << "\"/>\n";
    out << "  </Collection>\n</VTKFile>\n";
    return out.str();
  }
} // namespace fiberloom
