#pragma once

#include <string>

#include "apps/textbook/scan/scan_algorithms.h"

namespace fathom::app::scan {

/// {"triangle", "width", "height"}: the three edge functions at the centre of every pixel of the
/// image, outside the triangle too; the inside of every edge is positive, as for edge-function.
/// Answer   {"edges": [{"edge", "a", "b", "c"}], "values": [[[e_BC, e_CA, e_AB], …], …]}, row by
///          row; both empty if the triangle has no area.
template <class Number>
Json edge_values(const Json& object, const Form& form);

/// The values of an answer as a file: CSV (x,y,BC,CA,AB, a pixel a line), or NPY of shape (height,
/// width, 3) in binary64.
/// Fails    InputError for NPY of a triangle without area.
enum class ValuesFormat { csv, npy };
std::string values_file(const Json& answer, ValuesFormat format);

}  // namespace fathom::app::scan
