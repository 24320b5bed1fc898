# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

# For Doxygen: a comment behind a member describes it, and so do the lines of
# it that clang-format has put below.
s|\([;,{]\) *// |\1 ///< |
s|^ \{16,\}// |///< |
