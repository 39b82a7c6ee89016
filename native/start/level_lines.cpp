#include "start/level_lines.h"

#include <array>

namespace fairing {

LevelPiece level_within(const Eigen::Vector3i& corners, const VectorX& values, double level, const Points& points) {
    std::array<Vector3, 2> ends;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
        const int a = corners[k];
        const int b = corners[(k + 1) % 3];
        if ((values[a] < level) == (values[b] < level)) continue;
        const double share = (level - values[a]) / (values[b] - values[a]);
        ends[count++] = (1.0 - share) * points.col(a) + share * points.col(b);
    }
    if (count < 2) return {};
    return {(ends[1] - ends[0]).norm(), 0.5 * (ends[0] + ends[1])};
}

}  // namespace fairing
