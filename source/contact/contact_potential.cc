// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/contact/contact_potential.h>
#include <fiberloom/contact/contact_scalars.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace fiberloom
{
  namespace
  {
    using Points = ContactElement::Points;

    /** By the sections: d is the difference of the centres. */
    SectionPair
    by_sections(const Vector15 &v)
    {
      SectionPair x;
      x << v.head<3>(), v.segment<6>(3), -v.head<3>(), v.tail<6>();
      return x;
    }

    SectionPair2
    by_sections(const Matrix15 &v)
    {
      constexpr std::array<unsigned int, 6> from{{0, 3, 6, 0, 9, 12}};
      SectionPair2                          x;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          x.block<3, 3>(3 * i, 3 * j) =
            ((i == 3) != (j == 3) ? -1. : 1.) * v.block<3, 3>(from[i], from[j]);
      return x;
    }

    /** The energy as a function of gap and spread. */
    struct NormalLaw
    {
      LawValue value;
      Spread   spread;

      /** Where a step's model takes other stiffness, what that adds. */
      NormalLaw(const ContactElement &contact,
                const double          gap,
                const double          cosine)
        : spread(contact, cosine)
      {
        const auto law = [&](const double penetration) {
          return contact.following == Points::closest ?
                   crossing_law(penetration,
                                contact.stiffness * spread.value,
                                contact.regularization) :
                   normal_law(penetration,
                              contact.stiffness * contact.length,
                              contact.regularization);
        };
        value = law(-gap);
        if (const double k = contact.stiffness_added; k != 0)
          value = gap > 0 ? LawValue{.5 * k * gap * gap, -k * gap, k} :
                            LawValue{0, 0, k};
        if (contact.following == Points::on_plane)
          spread.first = spread.second = 0;
        spread.first /= spread.value;
        spread.second /= spread.value;
      }
    };

    void
    store(ContactElement      &contact,
          const Configuration &c,
          const double         gap,
          const LawValue      &law)
    {
      contact.gap          = gap;
      contact.normal_force = std::max(0., law.force);
      contact.status       = law.force > 0 ? ContactElement::Status::stick :
                                             ContactElement::Status::open;
      contact.normal       = c.sign(contact) * c.d.normalized();
    }

    void
    set_nodes(const PointPair &points, ContactPotential &potential)
    {
      potential.n = 0;
      for (unsigned int s = 0; s < 2; ++s)
        for (unsigned int a = 0; a < points[s].weights.n; ++a)
          {
            const LineWeights &weights   = points[s].weights;
            potential.nodes[potential.n] = weights.first_node + a;
            potential.fiber[potential.n] = s;
            potential.value[potential.n] = weights.value[a];
            potential.first[potential.n] = weights.first[a];
            ++potential.n;
          }
    }

    /** As if normal and points stood still: what is left is positive. */
    void
    set_positive(const Configuration  &c,
                 const ContactElement &contact,
                 const LawValue       &law,
                 ContactPotential     &potential)
    {
      const SectionPair &slope = potential.force_slope;
      SectionPair2       both  = slope * slope.transpose() / law.derivative;
      for (unsigned int s = 0; s < 2 && law.force > 0; ++s)
        {
          const Vector3 &N      = contact.normal;
          const double   across = 1 / (1 - std::pow(N.dot(c.t[s]), 2));
          const double   v1 = N.dot(c.g[s][0]), v2 = N.dot(c.g[s][1]);
          const double   norm = std::hypot(v1, v2);
          const double   factor =
            law.force * std::sqrt(across) / (norm * norm * norm);
          Vector6 turned;
          turned << v2 * N, -v1 * N;
          both.block<6, 6>(9 * s + 3, 9 * s + 3) +=
            factor * turned * turned.transpose();
        }
      for (unsigned int s = 0; s < 2; ++s)
        for (unsigned int r = 0; r < 2; ++r)
          {
            potential.both[s][r] = both.block<9, 9>(9 * s, 9 * r);
            potential.row[s][r].setZero();
            potential.column[s][r].setZero();
          }
    }

    /** The conditions on the points of contact, and how these slide with the
     * sections, along the fibers from number @p first on. */
    struct Sliding
    {
      template <typename Jacobian>
      Sliding(const ContactElement &contact,
              const PointPair      &points,
              const Jacobian       &jacobian);

      /** With which the conditions count in the slope of what has the slope
       * @p v by the sections, points kept. */
      Eigen::Vector2d
      multipliers(const SectionPair &v) const
      {
        return n == 1 ? Eigen::Vector2d(-slopes(v)[1] * inverse(0, 0), 0) :
                        Eigen::Vector2d(-inverse.transpose() * slopes(v));
      }

      /** Along the fibers. */
      Eigen::Vector2d
      slopes(const SectionPair &v) const
      {
        return {v.head<9>().dot(points[0].slope),
                v.tail<9>().dot(points[1].slope)};
      }

      const PointPair           &points;
      unsigned int               n, first;
      std::array<Vector6, 2>     conditions{{Vector6::Zero(), Vector6::Zero()}};
      std::array<SectionPair, 2> by_points, slide;
      Eigen::Matrix2d            inverse = Eigen::Matrix2d::Zero();
    };

    template <typename Jacobian>
    Sliding::Sliding(const ContactElement &contact,
                     const PointPair      &points,
                     const Jacobian       &jacobian)
      : points(points)
      , n(contact.following == Points::on_plane ? 1 : 2)
      , first(2 - n)
    {
      conditions[0][along_1]     = 1;
      conditions[n - 1][along_2] = n == 1 ? contact.orientation : 1;
      for (unsigned int k = 0; k < n; ++k)
        by_points[k] =
          by_sections(Vector15(jacobian.transpose() * conditions[k]));
      if (n == 1)
        {
          inverse(0, 0) = 1 / slopes(by_points[0])[1];
          slide[0]      = -inverse(0, 0) * by_points[0];
          return;
        }
      Eigen::Matrix2d system;
      system << slopes(by_points[0]).transpose(),
        slopes(by_points[1]).transpose();
      inverse = system.inverse();
      for (unsigned int k = 0; k < 2; ++k)
        slide[k] = -inverse(k, 0) * by_points[0] - inverse(k, 1) * by_points[1];
    }

    /** Of the energy by the scalars. */
    Matrix6
    curvature(const NormalLaw &law, const Gap &gap, const Points following)
    {
      Matrix6 curvature =
        law.value.derivative * gap.gradient * gap.gradient.transpose() -
        law.value.force * gap.hessian;
      if (following == Points::on_plane)
        return curvature;
      const Vector6 mixed = -law.value.force * law.spread.first * gap.gradient;
      curvature.col(cosine) += mixed;
      curvature.row(cosine) += mixed.transpose();
      curvature(cosine, cosine) += law.value.energy * law.spread.second;
      return curvature;
    }

    /** From the @p hessian where the points are kept. Where they slide by y,
     * forces on the sections along the fibers count as well: H + l y^T + y l^T.
     */
    void
    set_exact(const SectionPair2 &hessian,
              const PointPair    &points,
              const Sliding      &sliding,
              ContactPotential   &potential)
    {
      const unsigned int         n = sliding.n, first = sliding.first;
      const auto                &slide = sliding.slide;
      const SectionPair         &L     = potential.residual;
      std::array<SectionPair, 2> half; // l, by the parts of y
      for (unsigned int k = 0; k < n; ++k)
        half[k] = first + k == 0 ?
                    SectionPair(hessian.leftCols<9>() * points[0].slope) :
                    SectionPair(hessian.rightCols<9>() * points[1].slope);
      Eigen::Matrix2d along = Eigen::Matrix2d::Zero();
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          {
            along(k, l) = first + l == 0 ?
                            half[k].head<9>().dot(points[0].slope) :
                            half[k].tail<9>().dot(points[1].slope);
            if (k == l)
              along(k, l) += first + k == 0 ?
                               L.head<9>().dot(points[0].second) :
                               L.tail<9>().dot(points[1].second);
          }
      SectionPair2 both = hessian;
      for (unsigned int k = 0; k < n; ++k)
        {
          SectionPair l = half[k];
          for (unsigned int j = 0; j < n; ++j)
            l += .5 * along(k, j) * slide[j];
          both.noalias() += l * slide[k].transpose();
          both.noalias() += slide[k] * l.transpose();
        }
      for (unsigned int s = 0; s < 2; ++s)
        for (unsigned int r = 0; r < 2; ++r)
          {
            potential.both[s][r] = both.block<9, 9>(9 * s, 9 * r);
            // Of the derivative of fiber s with the slide of its point.
            if (s < first)
              potential.row[s][r].setZero();
            else
              potential.row[s][r] =
                L.segment<9>(9 * s) *
                slide[s - first].segment<9>(9 * r).transpose();
            potential.column[r][s] = potential.row[s][r].transpose();
          }
    }
  } // namespace



  void
  follow_points(ContactElement  &contact,
                const FiberMesh &mesh,
                const DofVector &q)
  {
    followed_points(contact, mesh, q);
  }



  double
  normal_energy(ContactElement  &contact,
                const FiberMesh &mesh,
                const DofVector &q)
  {
    const PointPair     points = followed_points(contact, mesh, q);
    const Configuration c(points);
    const double gap = gap_of(c.scalars, c.sign(contact), contact.offset);
    if (contact.lost)
      return 0;
    const LawValue law = NormalLaw(contact, gap, c.scalars[cosine]).value;
    store(contact, c, gap, law);
    return law.energy;
  }



  bool
  evaluate_normal(ContactElement   &contact,
                  const FiberMesh  &mesh,
                  const DofVector  &q,
                  ContactPotential &potential,
                  const Curvature   asked)
  {
    const PointPair     points = followed_points(contact, mesh, q);
    const Configuration c(points);
    const double        sign = c.sign(contact);
    contact.normal_force     = 0;
    contact.status           = ContactElement::Status::open;
    if (contact.lost)
      return false;
    contact.gap = gap_of(c.scalars, sign, contact.offset);
    const bool predicted =
      contact.stiffness_added != 0 && asked != Curvature::none;
    if (contact.gap >= 0 && !predicted)
      return false;

    const Gap       gap = gap_with_derivatives(c.scalars, sign, contact.offset);
    const NormalLaw law(contact, gap.value, c.scalars[cosine]);
    store(contact, c, gap.value, law.value);
    set_nodes(points, potential);

    // Derivatives by the scalars, then by the sections, points kept.
    const auto jacobian   = jacobian_of(c);
    Vector6    by_scalars = -law.value.force * gap.gradient;
    by_scalars[cosine] += law.value.energy * law.spread.first;
    Vector6 force_by_scalars = -law.value.derivative * gap.gradient;
    force_by_scalars[cosine] += law.value.force * law.spread.first;
    potential.residual =
      by_sections(Vector15(jacobian.transpose() * by_scalars));
    potential.force_slope =
      by_sections(Vector15(jacobian.transpose() * force_by_scalars));

    const Sliding sliding(contact, points, jacobian);
    const auto    multipliers = sliding.multipliers(potential.residual),
               of_force       = sliding.multipliers(potential.force_slope);
    for (unsigned int k = 0; k < sliding.n; ++k)
      {
        potential.residual += multipliers[k] * sliding.by_points[k];
        potential.force_slope += of_force[k] * sliding.by_points[k];
        by_scalars += multipliers[k] * sliding.conditions[k];
      }
    if (asked == Curvature::none)
      return true;
    if (asked != Curvature::exact || predicted)
      {
        set_positive(c, contact, law.value, potential);
        return true;
      }

    Matrix15 by_vectors =
      jacobian.transpose() * curvature(law, gap, contact.following) * jacobian;
    add_second_derivatives(c, by_scalars, by_vectors);
    set_exact(by_sections(by_vectors), points, sliding, potential);
    return true;
  }
} // namespace fiberloom
