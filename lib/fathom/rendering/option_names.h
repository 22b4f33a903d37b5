#pragma once

#include <array>
#include <string_view>

#include "fathom/image/channel_table.h"
#include "fathom/mesh/normal_source.h"
#include "fathom/rendering/options.h"

/// The names of the values of RenderOptions: the only place that states them for the command line,
/// Python, messages and the texts of a map. Lists are in the order of messages; value_named()
/// (unknown_name.h) finds a value by its name.
namespace fathom {

inline constexpr std::array all_engines{Engine::fast, Engine::reference};

inline constexpr std::array all_culls{Cull::back, Cull::front, Cull::none};
/// "back", "front" or "none".
std::string_view name_of(Cull cull);

inline constexpr std::array all_normal_sources{NormalSource::file, NormalSource::vertex,
                                               NormalSource::place};

inline constexpr std::array all_stored_types{StoredType::binary32, StoredType::binary64,
                                             StoredType::scaled_unorm16};
/// The type of an array in NumPy: "float32", "float64" or "uint16".
std::string_view name_of(StoredType type);

}  // namespace fathom
