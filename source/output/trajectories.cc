// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/tow_family.h>

#include <fiberloom/output/fiber_samples.h>
#include <fiberloom/output/tow_sections.h>
#include <fiberloom/output/trajectories.h>

#include <sstream>

namespace fiberloom
{
  namespace
  {
    void
    write_position(std::ostream &out, const double abscissa, const Vector3 &p)
    {
      out << "," << abscissa << "," << p[0] << "," << p[1] << "," << p[2];
    }

    void
    write_tow(std::ostream                  &out,
              const Tow                     &tow,
              const unsigned int             number,
              const std::vector<TowSection> &sections)
    {
      for (std::size_t i = 0; i < sections.size(); ++i)
        {
          const TowSection &section = sections[i];
          out << "tow," << family_name(tow.family) << "," << number << ",,"
              << i;
          write_position(out, section.abscissa, section.centroid);
          out << ",," << section.width << "," << section.height << ","
              << section.area << "," << section.packing << "\n";
        }
    }

    void
    write_fiber(std::ostream                   &out,
                const Tow                      &tow,
                const unsigned int              number,
                const unsigned int              fiber,
                const std::vector<FiberSample> &samples)
    {
      double abscissa = 0;
      for (std::size_t i = 0; i < samples.size(); ++i)
        {
          if (i > 0)
            abscissa +=
              (samples[i].section.center - samples[i - 1].section.center)
                .norm();
          out << "fiber," << family_name(tow.family) << "," << number << ","
              << fiber << "," << i;
          write_position(out, abscissa, samples[i].section.center);
          out << "," << samples[i].curvature << ",,,,\n";
        }
    }
  } // namespace



  std::string
  trajectories_csv(const FiberSet  &fibers,
                   const FiberMesh &mesh,
                   const DofVector &q)
  {
    std::ostringstream out;
    out.precision(10);
    out << "kind,family,tow,fiber,station,abscissa[mm],x[mm],y[mm],z[mm],"
           "curvature[1/mm],width[mm],height[mm],area[mm2],packing\n";
    for (unsigned int t = 0; t < fibers.tows.size(); ++t)
      {
        const Tow &tow = fibers.tows[t];
        write_tow(out, tow, t, tow_sections(fibers, mesh, q, t));
        for (const unsigned int fiber : tow.fibers)
          write_fiber(out, tow, t, fiber, sample_fiber(mesh, q, fiber, 2));
      }
    return out.str();
  }
} // namespace fiberloom
