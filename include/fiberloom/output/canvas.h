// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_canvas_h
#define fiberloom_output_canvas_h

#include <fiberloom/base/vector_types.h>

#include <fiberloom/output/colors.h>

#include <array>
#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * A picture of triangles with a depth buffer, drawn without any display: VTK
   * as Debian builds it renders through an X server only. Positions are
   * pixels to the right, pixels downwards, and the distance from the eye in
   * the same unit. What lies deeper than its surroundings is darkened, which
   * tells the eye what is in front (depth buffer unsharp masking, Luft,
   * Colditz, Deussen 2006).
   */
  class Canvas
  {
  public:
    /** A corner of a triangle; its position is given as for the canvas. */
    struct Corner
    {
      Vector3 position;
      Vector3 normal; // unit, third component towards the eye
    };

    Canvas(const unsigned int width, const unsigned int height);

    /**
     * Leaves out triangles whose normals all point away from the eye, the
     * inner sides of closed bodies. @p object : neighbouring pixels of other
     * objects get a dark border.
     */
    void
    draw(const std::array<Corner, 3> &corners,
         const Color                 &color,
         const int                    object);

    /**
     * Shaded, with shadows of depth over @p reach pixels, four pixels
     * averaged to one: content of a PNG file.
     */
    std::string
    png(const double reach) const;

  private:
    struct Pixel
    {
      float                depth  = std::numeric_limits<float>::max();
      int                  object = -1;
      std::array<float, 3> normal{{0, 0, 0}};
    };

    const Pixel &
    at(const unsigned int x, const unsigned int y) const
    {
      return pixels[y * width + x];
    }

    /** Mean depth around each pixel of the picture, blurred over @p reach . */
    std::vector<float>
    blurred_depth(const double reach) const;

    bool
    is_border(const unsigned int x, const unsigned int y) const;

    std::array<float, 3>
    shade(const unsigned int x, const unsigned int y, const float shadow) const;

    unsigned int       width, height;
    std::vector<Pixel> pixels;
    std::vector<Color> colors; // of objects
  };
} // namespace fiberloom

#endif
