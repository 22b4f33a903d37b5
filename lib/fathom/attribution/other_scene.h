#pragma once

#include "fathom/attribution/judgement.h"

namespace fathom::attribution {

/// Where a map fits its scene nowhere, that is the finding, in place of the triangles that would
/// have to be missing: the map shows nothing, the scene has nothing in view, or of the pixels that
/// show a surface in either, nine tenths or more are unexplained and no fault of the whole image
/// explains them, which is what the map of another scene or camera looks like. Not where nine
/// tenths of them show about the depth that they should: then it is the scene.
void name_other_scene(Judgement& judgement);

}  // namespace fathom::attribution
