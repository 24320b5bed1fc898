# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""One number of a reference case, beside what it should be."""

import math


class Check:
    """A number that may be off by a tolerance, over the reference unless `absolute`.

    `published` is what the source gives, where the reference is that with the program's law
    of the section in place of the source's.
    """

    def __init__(self, quantity, reference, computed, tolerance, absolute=False, published=None):
        self.quantity, self.reference, self.computed = quantity, reference, computed
        self.tolerance, self.absolute, self.published = tolerance, absolute, published

    def verdict(self):
        return "ok" if self.good() else "FAILED"

    def error(self):
        return (self.computed - self.reference) / (1 if self.absolute else abs(self.reference))

    def good(self):
        return abs(self.error()) <= self.tolerance  # false for NaN

    def shown_reference(self):
        if self.published is None:
            return f"{self.reference:.7g}"
        return f"{self.reference:.7g} (published {self.published:.7g})"

    def shown_error(self):
        return f"{self.error():+.1e}" if self.absolute else f"{100 * self.error():+.3g} %"

    def shown_tolerance(self):
        return f"{self.tolerance:.1e}" if self.absolute else f"{100 * self.tolerance:.3g} %"


class Bound(Check):
    """A number that must lie between two others."""

    def __init__(self, quantity, computed, least=-math.inf, most=math.inf):
        self.quantity, self.computed, self.least, self.most = quantity, computed, least, most

    def good(self):
        return self.least <= self.computed <= self.most

    def shown_reference(self):
        return ""

    def shown_error(self):
        return ""

    def shown_tolerance(self):
        bounds = [f"{sign} {bound:.4g}" for sign, bound in ((">=", self.least), ("<=", self.most)) if math.isfinite(bound)]
        return " and ".join(bounds)


class Report(Bound):
    """A number that is shown beside that of others, and not judged."""

    def __init__(self, quantity, computed, others):
        super().__init__(quantity, computed)
        self.others = others

    def verdict(self):
        return "reported"

    def shown_reference(self):
        return self.others


def observed_order(coarse, medium, fine, ratio=2):
    """From three results, each on a mesh `ratio` times as fine as the one before."""
    return math.log(abs(coarse - medium) / abs(medium - fine)) / math.log(ratio)
