// Prints the constants of the error bounds, one "NAME VALUE" in each line, exactly: what
// check-proofs proves with.
#include <cstdio>

#include "fathom/evaluation/box_tree.h"
#include "fathom/fast/channels/resolve_bounds.h"
#include "fathom/fast/coverage/square_edges.h"
#include "fathom/fast/lenses/plane_places.h"
#include "fathom/fast/lenses/window.h"
#include "fathom/fast/setup/setup_bounds.h"
#include "fathom/fast/vertices/vertex.h"
#include "fathom/lens/stage.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/double_word.h"
#include "fathom/rays/ray_bounds.h"
#include "fathom/triangle/certified_surface.h"

int main() {
  using namespace fathom;
  const auto print = [](const char* name, double value) { std::printf("%s %a\n", name, value); };
  print("affine_error", fast::vertex_bounds::affine_error);
  print("quotient_error", fast::vertex_bounds::quotient_error);
  print("reciprocal_error", fast::vertex_bounds::reciprocal_error);
  print("greatest_relative_error_of_W", fast::vertex_bounds::greatest_relative_error_of_W);
  print("missed_form", fast::vertex_bounds::missed_form);
  print("vertex_slack", fast::vertex_bounds::slack);

  print("area_by_corners", fast::setup_bounds::area_by_corners);
  print("area_rounding", fast::setup_bounds::area_rounding);
  print("box_margin", fast::setup_bounds::box_margin);
  print("edge_by_corners", fast::setup_bounds::edge_by_corners);
  print("edge_rounding", fast::setup_bounds::edge_rounding);
  print("triangle_thinness", fast::setup_bounds::triangle_thinness);
  print("q_by_corners", fast::setup_bounds::q_by_corners);
  print("q_rounding", fast::setup_bounds::q_rounding);
  print("q_of_corner", fast::setup_bounds::q_of_corner);
  print("q_left", fast::setup_bounds::q_left);
  print("q_moves", fast::setup_bounds::q_moves);
  print("q_room", fast::setup_bounds::q_room);
  print("lane_error", fast::setup_bounds::lane_error);
  print("lane_room", fast::setup_bounds::lane_room);
  print("lane_extent", fast::lens_bounds::lane_extent);
  print("window_rounding", fast::lens_bounds::window_rounding);
  print("range_room", fast::lens_bounds::range_room);
  print("place_room", fast::lens_bounds::place_room);
  print("greatest_place_error", fast::lens_bounds::greatest_error);
  print("rectangle_margin", fast::lens_bounds::rectangle_margin);
  print("rectangle_rounding", fast::lens_bounds::rectangle_rounding);
  print("plane_rounding", fast::place_arithmetic::plane_rounding);
  print("plane_quotient", fast::place_arithmetic::plane_quotient);
  print("ball_share", fast::place_arithmetic::ball_share);
  print("disc_room", fast::place_arithmetic::disc_room);
  print("beyond_room", fast::place_arithmetic::beyond_room);
  print("lift_rounding", fast::place_arithmetic::lift_rounding);
  print("end_of_series", fast::place_arithmetic::end_of_series);
  print("turn_rounding", fast::place_arithmetic::turn_rounding);
  print("square_rounding", fast::place_arithmetic::square_rounding);
  print("bend_rounding", fast::place_arithmetic::bend_rounding);
  print("place_rounding", fast::place_arithmetic::place_rounding);
  print("loose_error", fast::place_arithmetic::loose_error);
  print("angle_of_error", fast::place_arithmetic::angle_of_error);
  print("angle_rounding", fast::place_arithmetic::angle_rounding);
  print("lens_up", lens::bounds::up);
  print("of_degree", lens::bounds::of_degree * unit_roundoff<double>);
  print("of_stage", lens::bounds::of_stage * unit_roundoff<double>);
  print("most_growth", lens::bounds::most_growth);
  print("interval_room", lens::bounds::interval_room);
  print("tile_q_error", fast::setup_bounds::tile_q_error);
  print("exact_edge_error", fast::setup_bounds::exact_edge_error);
  print("exact_q_error", fast::setup_bounds::exact_q_error);
  print("wide_terms", fast::setup_bounds::wide_terms);
  print("wide_difference", fast::setup_bounds::wide_difference);
  print("moved_share", fast::setup_bounds::moved_share);
  print("shape_share", fast::setup_bounds::shape_share);
  print("range_end_rounding", fast::setup_bounds::range_end_rounding);
  print("shape_rounding", fast::setup_bounds::shape_rounding);

  print("crossing_error", fast::area_bounds::crossing_error);
  print("moved_edge", fast::area_bounds::moved_edge);
  print("moved_triangle", fast::area_bounds::moved_triangle);
  print("moved_length", fast::area_bounds::moved_length);
  print("moved_end", fast::area_bounds::moved_end);
  print("cut_error", fast::area_bounds::cut_error);
  print("cut_rounding", fast::area_bounds::cut_rounding);

  print("far", fast::area_bounds::far);
  print("rounding_room", fast::area_bounds::rounding_room);

  print("corner_error", evaluation::bounds::corner_error);
  print("point_error", evaluation::bounds::point_error);
  print("difference_error", evaluation::bounds::difference_error);
  print("distance_error", evaluation::bounds::distance_error);

  print("end_room", fast::resolve_bounds::end_room);
  print("spread_room", fast::resolve_bounds::spread_room);
  print("greatest_residual", fast::resolve_bounds::greatest_residual);
  print("weight_rounding", fast::resolve_bounds::weight_rounding);
  print("greatest_relative_error_of_q", fast::resolve_bounds::greatest_relative_error);

  print("ray_products", rays::bounds::of_products);
  print("ray_direction", rays::bounds::of_direction);
  print("ray_origin", rays::bounds::of_origin);
  print("ray_corners", rays::bounds::of_corners);
  print("ray_size_room", rays::bounds::size_room);
  print("ray_height", rays::bounds::of_height);
  print("ray_height_corners", rays::bounds::of_height_corners);
  print("ray_height_origin", rays::bounds::of_height_origin);
  print("ray_normal", rays::bounds::of_normal);
  print("ray_slack", rays::bounds::slack);
  print("ray_far_room", double{rays::bounds::far_room});

  print("interval_widening", interval_widening);
  print("distance_room", distance_room);
  print("sign_room", sign_room);
  print("quotient_condition", quotient_condition);
  print("slack", slack);
  print("root_error", root_error);

  print("normal", triangle::surface_bounds::normal);
  print("placed_normal", triangle::surface_bounds::placed_normal);
  print("constant_form", triangle::surface_bounds::constant_form);
  print("form", triangle::surface_bounds::form);
  print("turn", triangle::surface_bounds::turn);
  print("length", triangle::surface_bounds::length);
  print("position", triangle::surface_bounds::position);
  print("ray_length", triangle::surface_bounds::ray_length);
}
