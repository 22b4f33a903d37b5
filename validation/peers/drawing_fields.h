#pragma once

#include <string>

#include "validation/child/fields.h"
#include "validation/peers/drawing.h"

/// The names under which what a renderer drew comes from its process.
namespace fathom::validation {

template <>
struct Enumerators<Storage> {
  static constexpr auto& all = all_storages;
  static std::string name(Storage storage) { return std::string(name_of(storage)); }
};

template <>
struct Enumerators<Mapping> {
  static constexpr auto& all = all_mappings;
  static std::string name(Mapping mapping) { return std::string(name_of(mapping)); }
};

template <>
struct Enumerators<EqualDepths> {
  static constexpr EqualDepths all[] = {EqualDepths::first_wins, EqualDepths::last_wins};
  static std::string name(EqualDepths rule) {
    return rule == EqualDepths::first_wins ? "first wins" : "last wins";
  }
};

template <>
struct Enumerators<attribution::RasterModel::Cut> {
  using Cut = attribution::RasterModel::Cut;
  static constexpr Cut all[] = {Cut::always, Cut::unknown, Cut::never};
  static std::string name(Cut cut) {
    constexpr const char* names[] = {"always", "unknown", "never"};
    return names[static_cast<std::size_t>(cut)];
  }
};

template <>
struct Alternatives<std::variant<attribution::RasterModel, attribution::RayModel>> {
  static constexpr const char* names[] = {"raster", "ray"};
};

template <>
struct Fields<attribution::OtherMap> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [width, height, depths, windows, triangles, values, code_scale] = s;
    visit("width", width);
    visit("height", height);
    visit("depths", depths);
    visit("values", values);
    visit("code_scale", code_scale);
    visit("windows", windows);
    visit("triangles", triangles);
  }
};

template <>
struct Fields<attribution::WrittenDepth> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [mapping, of_w, term, factor, scale] = s;
    visit("mapping", mapping);
    visit("of_w", of_w);
    visit("term", term);
    visit("factor", factor);
    visit("scale", scale);
  }
};

template <>
struct Fields<attribution::RasterModel> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    // A mesh drawn in a process of its own is one part.
    [[maybe_unused]] auto& [shift, scale, shift_as_vtk, matrix, parts, premultiplied, subpixel_bits,
                            border, mapping, storage, written, depth_before_snap, nearest_codes,
                            decoded_in_binary32, bias, bias_error, affine] = s;
    visit("shift", shift);
    visit("scale", scale);
    visit("shift_as_vtk", shift_as_vtk);
    visit("matrix", matrix);
    visit("premultiplied", premultiplied);
    visit("subpixel_bits", subpixel_bits);
    visit("border", border);
    visit("mapping", mapping);
    visit("storage", storage);
    visit("written", written);
    visit("depth_before_snap", depth_before_snap);
    visit("nearest_codes", nearest_codes);
    visit("decoded_in_binary32", decoded_in_binary32);
    visit("bias", bias);
    visit("bias_error", bias_error);
    visit("affine", affine);
  }
};

template <>
struct Fields<attribution::RayModel> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    // Renderers that draw in a child have the camera's rays.
    [[maybe_unused]] auto& [shift, roundings, rotation_error, depth_from_point, rays] = s;
    visit("shift", shift);
    visit("roundings", roundings);
    visit("rotation_error", rotation_error);
    visit("depth_from_point", depth_from_point);
  }
};

template <>
struct Fields<attribution::SamplePosition> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    // The renderers that draw in a child have no lenses.
    [[maybe_unused]] auto& [x, y, error, k1, k2, lens] = s;
    visit("x", x);
    visit("y", y);
    visit("error", error);
    visit("k1", k1);
    visit("k2", k2);
  }
};

template <>
struct Enumerators<attribution::DepthTerm> {
  using Term = attribution::DepthTerm;
  static constexpr Term all[] = {Term::depth, Term::inverse, Term::logarithm};
  static std::string name(Term term) {
    constexpr const char* names[] = {"depth", "inverse", "logarithm"};
    return names[static_cast<std::size_t>(term)];
  }
};

template <>
struct Enumerators<attribution::RecordedDepth::Rounding> {
  using Rounding = attribution::RecordedDepth::Rounding;
  static constexpr Rounding all[] = {Rounding::binary32, Rounding::binary16, Rounding::nearest,
                                     Rounding::down};
  static std::string name(Rounding rounding) {
    constexpr const char* names[] = {"binary32", "binary16", "nearest", "down"};
    return names[static_cast<std::size_t>(rounding)];
  }
};

template <>
struct Fields<attribution::RecordedDepth> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [term, factor, offset, rounding, origin, step, error] = s;
    visit("term", term);
    visit("factor", factor);
    visit("offset", offset);
    visit("rounding", rounding);
    visit("origin", origin);
    visit("step", step);
    visit("error", error);
  }
};

template <>
struct Fields<attribution::RendererModel> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [name, sample, watertight, equal_depths, recorded, kind] = s;
    visit("name", name);
    visit("sample", sample);
    visit("watertight", watertight);
    visit("equal_depths", equal_depths);
    visit("recorded", recorded);
    visit("kind", kind);
  }
};

template <>
struct Fields<DrawnMap> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [map, model, version] = s;
    visit("map", map);
    visit("model", model);
    visit("version", version);
  }
};

template <>
struct Fields<Drawing> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [drawn, failure] = s;
    visit("drawn", drawn);
    visit("failure", failure);
  }
};

template <>
struct Fields<GreyPicture> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [width, height, codes, version] = s;
    visit("width", width);
    visit("height", height);
    visit("codes", codes);
    visit("version", version);
  }
};

}  // namespace fathom::validation
