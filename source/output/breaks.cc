// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/breaks.h>
#include <fiberloom/output/increment_table.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace fiberloom
{
  std::string
  breaks_csv(const FiberMesh &mesh, const FiberHistory &history)
  {
    std::vector<std::pair<unsigned int, Break>> breaks(history.breaks.begin(),
                                                       history.breaks.end());
    std::sort(breaks.begin(), breaks.end(), [](const auto &a, const auto &b) {
      return a.second.number < b.second.number;
    });

    std::ostringstream out;
    out << "stage,increment,load,fiber,tow,element,x[mm],y[mm],z[mm],"
           "stress[MPa]\n";
    for (const auto &[element, entry] : breaks)
      {
        const unsigned int     fiber = mesh.fiber_of_element(element);
        const FiberMesh::Line &line  = mesh.lines()[fiber];
        out << entry.stage << "," << entry.increment << ","
            << table_cell(entry.load) << "," << fiber << "," << line.tow << ","
            << element - line.first_element;
        for (unsigned int i = 0; i < 3; ++i)
          out << "," << table_cell(entry.place[i]);
        out << "," << table_cell(line.young_modulus * entry.strain) << "\n";
      }
    return out.str();
  }
} // namespace fiberloom
