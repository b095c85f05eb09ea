// SPDX-License-Identifier: GPL-3.0-or-later
/// Which input matters: Sobol indices and derivative-based indices of a study's quantities, and what they tell, in sentences.
#pragma once

#include <string>
#include <vector>

#include "earthtop/watch.hpp"
#include "study/json_text.hpp"
#include "study/statistics.hpp"
#include "study/store.hpp"

namespace earthtop::study {

/// The base points of a quantity's indices.
struct IndexBasis {
  std::uint64_t planned = 0;        ///< base points of the design
  std::uint64_t computed = 0;       ///< those of which every point has been computed
  std::uint64_t used = 0;           ///< those of which every point has a value, too
  std::uint64_t points = 0;         ///< points computed
  std::uint64_t without_value = 0;  ///< those among them that failed or have no value
  bool left_out() const { return used < computed; }
};

/// The indices of one input, with its name.
struct InputIndex {
  std::string name;
  SobolIndex index;
};

/// A sentence on which input matters most for a quantity, which comes second, and whether inputs act together: as far as two
/// standard errors tell. Where they do not tell the order of two inputs, it says how many base points would, from standard errors that
/// fall with the square root of that number.
/// @param inputs  at least one
std::string influence_sentence(const std::string& quantity, const std::vector<InputIndex>& inputs, const IndexBasis& basis);

/// From how many base points the indices of a quantity are, in words: "from 40 of 64 base points".
std::string basis_text(const IndexBasis& basis);
/// What base points that were left out make of the indices; empty where none was.
std::string left_out_warning(const IndexBasis& basis);
std::string no_indices_reason(const IndexBasis& basis);

/// Adds to a study's document `indices`, `indices_basis` and `indices_note`, from another pass over the points.
void add_sobol_indices(Store& store, const std::vector<Moments>& moments, const Watch& watch, Json& document);

/// Adds to a study's document `derivative_indices` and `derivative_notes` if the study collects derivatives of the drift.
void add_derivative_indices(Store& store, const std::vector<Moments>& moments, const Watch& watch, Json& document);

}  // namespace earthtop::study
