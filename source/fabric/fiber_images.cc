// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/fabric/fiber_images.h>

namespace fiberloom
{
  FiberImages::FiberImages(const FiberSet &cell)
  {
    fibers      = cell;
    fibers.cell = {};
    fibers.fibers.clear();
    for (const int across : {0, 1})
      {
        unsigned int first = 0; // node of the fiber
        for (const Fiber &fiber : cell.fibers)
          {
            const Tow         &tow   = cell.tows[fiber.tow];
            const unsigned int along = direction(tow);
            const int          n     = fiber.centers.size() - 1;
            Fiber              image = fiber;
            image.centers.clear();
            image.directions_1.clear();
            image.directions_2.clear();
            for (int k = -n; k <= 2 * n; ++k)
              {
                const int          period = (k + n) / n - 1;
                const unsigned int node   = k - period * n;
                NodeImage          name{first + node, {{0, 0}}};
                name.periods[along]     = period;
                name.periods[1 - along] = across;
                nodes.push_back(name);
                Vector3 center = fiber.centers[node];
                for (unsigned int d = 0; d < 2; ++d)
                  center[d] += name.periods[d] * (*cell.cell)[d];
                image.centers.push_back(center);
                image.directions_1.push_back(fiber.directions_1[node]);
                image.directions_2.push_back(fiber.directions_2[node]);
              }
            first += fiber.centers.size();
            fibers.fibers.push_back(image);
          }
      }
  }



  bool
  FiberImages::is_pair(const unsigned int first,
                       const unsigned int second) const
  {
    const unsigned int n = n_originals();
    if (first < n && second < n)
      return true;
    const auto family = [this](const unsigned int fiber) {
      return fibers.tows[fibers.fibers[fiber].tow].family;
    };
    return (first < n || second < n) && family(first) == family(second);
  }
} // namespace fiberloom
