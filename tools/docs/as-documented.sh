#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A header as Doxygen shall read it, line by line at the same numbers. The comment that a header begins with describes the file; without
# @file it would be taken for the namespace's. Explicit instantiations declare nothing that the template has not declared already.
#   tools/docs/as-documented.sh HEADER
exec sed -e 's,^#pragma once$,/// @file,' -e '/^extern template/,/;$/s/.*//' "$1"
