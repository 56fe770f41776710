// SPDX-License-Identifier: MIT
#include "build/options.hpp"

#include <string>

#include "boxwood/error.hpp"
#include "boxwood/requirements.hpp"

namespace boxwood {

BuildOptions resolve(const Scene& scene, BuildOptions options) {
    const bool oriented = options.bounds.kind != Bounds::aabb;
    const std::string kind(name(options.bounds.kind));
    if (oriented && options.layout == Layout::wide8)
        throw InputError("layout", std::string(name(options.layout)),
                         "holds axis-aligned boxes only; oriented boxes (" + kind + ") need the layout binary");
    if (!options.areas.empty() && (oriented || options.levels == Levels::two))
        throw InputError("areas", oriented ? kind : "levels two",
                         "influence areas need one level of axis-aligned boxes");
    if (options.areas.empty() && needs_areas(options.builder))
        throw InputError("builder", std::string(name(options.builder)), "needs influence areas");
    validate(options.areas, "influence areas");
    if (options.layout == Layout::automatic) options.layout = oriented ? Layout::binary : Layout::wide8;
    options.levels = requirements(scene, options).two_levels ? Levels::two : Levels::one;
    return options;
}

} // namespace boxwood
