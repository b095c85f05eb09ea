// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#define GEOGRAPHICLIB_VERSION_STRING "none: closed formula of normal gravity"
