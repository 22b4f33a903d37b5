#include "fathom/depth_format/pipeline_model.h"

#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fathom/depth_format/depth_bias.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// A number of the model: a binary32 number, or an exact one. They differ only in speed.
using Number = std::variant<float, Ratio>;

Ratio exact(const Number& x) {
  if (const auto* rounded = std::get_if<float>(&x)) return Dyadic(static_cast<double>(*rounded));
  return std::get<Ratio>(x);
}

Number checked(float x) {
  if (!std::isfinite(x)) throw UsageError("the pipeline model: a number leaves binary32's range");
  return x;
}

Number rounded(const Ratio& x, bool rounds) {
  return rounds ? checked(round_to_binary32(x)) : Number(x);
}

/// One operation: in binary32 if it rounds. On binary32 operands the processor's own operation is
/// the exact result rounded once, as IEEE 754 requires; otherwise the exact result is rounded.
template <class Operation>
Number apply(const Number& a, const Number& b, bool rounds, const Operation& operation) {
  const auto* x = std::get_if<float>(&a);
  const auto* y = std::get_if<float>(&b);
  if (rounds && x != nullptr && y != nullptr) return checked(operation(*x, *y));
  return rounded(operation(exact(a), exact(b)), rounds);
}

Number add(const Number& a, const Number& b, bool rounds) {
  return apply(a, b, rounds, [](const auto& x, const auto& y) { return x + y; });
}

Number subtract(const Number& a, const Number& b, bool rounds) {
  return apply(a, b, rounds, [](const auto& x, const auto& y) { return x - y; });
}

Number multiply(const Number& a, const Number& b, bool rounds) {
  return apply(a, b, rounds, [](const auto& x, const auto& y) { return x * y; });
}

float quotient(float a, float b) {
  return a / b;
}

Number divide(const Number& a, const Number& b, bool rounds) {
  return apply(a, b, rounds, [](const auto& x, const auto& y) { return quotient(x, y); });
}

/// z_clip = A·depth + B, w_clip = depth; exactly.
struct DepthProjection {
  Ratio A, B;
};

/// nullopt if the mapping is not a projection.
std::optional<DepthProjection> find_projection(const DepthFormat& format) {
  const Ratio n = Dyadic(format.near), one = Dyadic(1.0), two = Dyadic(2.0);
  switch (format.mapping) {
    case Mapping::infinite:
      return DepthProjection{one, Ratio() - n};
    case Mapping::reversed_infinite:
      return DepthProjection{Ratio(), n};
    case Mapping::standard:
    case Mapping::reversed:
    case Mapping::opengl:
      break;
    default:
      return std::nullopt;
  }
  const Ratio f = Dyadic(format.far), range = f - n;
  if (format.mapping == Mapping::standard) {
    return DepthProjection{quotient(f, range), quotient(Ratio() - f * n, range)};
  }
  if (format.mapping == Mapping::reversed) {
    return DepthProjection{quotient(Ratio() - n, range), quotient(f * n, range)};
  }
  return DepthProjection{quotient(f + n, range), quotient(Ratio() - two * f * n, range)};
}

DepthProjection projection_of(const DepthFormat& format) {
  if (const auto projection = find_projection(format)) return *projection;
  std::vector<std::string> names;
  for (const Mapping mapping : all_mappings) {
    if (find_projection({.mapping = mapping})) names.emplace_back(name_of(mapping));
  }
  throw UsageError("the pipeline model has no projection for mapping " +
                   std::string(name_of(format.mapping)) + "; there are " + joined(names, ", "));
}

using Row = std::array<Number, 4>;

Row view_row(const PipelineModel& model) {
  Row row;
  for (int i = 0; i < 4; ++i) row[i] = rounded(Dyadic(model.view[i]), model.rounding.matrix);
  return row;
}

/// ((r₀·x + r₁·y) + r₂·z) + r₃
Number times_vertex(const Row& row, const Vertex& p, bool rounds) {
  Number sum = multiply(row[0], p[0], rounds);
  sum = add(sum, multiply(row[1], p[1], rounds), rounds);
  sum = add(sum, multiply(row[2], p[2], rounds), rounds);
  return add(sum, row[3], rounds);
}

struct Clip {
  Number z, w;
};

Clip clip_coordinates(const PipelineModel& model, const Vertex& vertex) {
  const DepthProjection projection = projection_of(model.format);
  const Number A = rounded(projection.A, model.rounding.matrix);
  const Number B = rounded(projection.B, model.rounding.matrix);
  const Row view = view_row(model);
  const bool rounds = model.rounding.transform;
  const Number w = times_vertex(view, vertex, rounds);
  if (!model.premultiplied) return {add(multiply(A, w, rounds), B, rounds), w};

  Row product;
  for (int i = 0; i < 4; ++i) product[i] = multiply(A, view[i], model.rounding.matrix);
  product[3] = add(product[3], B, model.rounding.matrix);
  return {times_vertex(product, vertex, rounds), w};
}

}  // namespace

Ratio exact_depth(const PipelineModel& model, const Vertex& vertex) {
  const StandardArithmetic standard;
  Dyadic depth(model.view[3]);
  for (int i = 0; i < 3; ++i) depth += Dyadic(model.view[i]) * Dyadic(vertex[i]);
  return depth;
}

Ratio window_depth(const PipelineModel& model, const Vertex& vertex) {
  const StandardArithmetic standard;
  const Clip clip = clip_coordinates(model, vertex);
  if (exact(clip.w).sign() == Sign::zero) {
    throw UsageError("the pipeline model: a vertex in the plane of the eye");
  }
  const bool rounds = model.rounding.division;
  const Number ndc = divide(clip.z, clip.w, rounds);
  if (model.format.mapping != Mapping::opengl) return exact(ndc);
  return exact(add(multiply(ndc, 0.5F, rounds), 0.5F, rounds));
}

Ratio interpolated_window_depth(const PipelineModel& model, const Vertex& a, const Vertex& b,
                                const Ratio& t) {
  const StandardArithmetic standard;
  const bool rounds = model.rounding.interpolation;
  const Number share = rounded(t, rounds);
  const Number z_a = rounded(window_depth(model, a), rounds);
  const Number z_b = rounded(window_depth(model, b), rounds);
  return exact(add(z_a, multiply(share, subtract(z_b, z_a, rounds), rounds), rounds));
}

Ratio stored_number(const PipelineModel& model, const Ratio& window_depth) {
  const StandardArithmetic standard;
  Ratio limited = biased_depth(window_depth, Ratio());
  if (!model.rounding.storage) return limited;
  return value_of(model.format.storage, round_to_storage(model.format.storage, limited));
}

}  // namespace fathom
