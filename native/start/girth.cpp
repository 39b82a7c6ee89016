#include "start/girth.h"

#include "operators/laplace_operator.h"
#include "start/clamped_fill.h"
#include "start/level_lines.h"

namespace fairing {

namespace {

constexpr int line_count = 17;
constexpr double first_level = 0.1;  // the last one as far from the other end

double level_of(int line) { return first_level + (1.0 - 2.0 * first_level) * line / (line_count - 1); }

}  // namespace

std::optional<CrossSections> CrossSections::of(const Patch& patch, const Progress& progress) {
    CrossSections result(patch);
    const std::vector<Indices> loops = patch.loops();
    const Stiffness even = uniform_stiffness(patch);
    LaplaceOperator laplace(patch);
    if (loops.size() < 2 || !laplace.update(even, progress)) return std::nullopt;
    for (const Indices& loop : loops) {
        Eigen::RowVectorXd field = Eigen::RowVectorXd::Zero(patch.vertex_count());
        for (const int v : loop) field[v] = 1.0;
        const Eigen::RowVectorXd pull = even.apply(patch, field, patch.free_count);
        field.head(patch.free_count) = -laplace.solve(pull.transpose()).transpose();
        result.levels_.emplace_back(field.transpose());
    }
    return result;
}

VectorX CrossSections::lengths(int outline, const Points& points) const {
    VectorX result = VectorX::Zero(line_count);
    for (int line = 0; line < line_count; ++line) {
        for (const auto triangle : patch_.triangles.colwise())
            result[line] += level_within(triangle, levels_[at(outline)], level_of(line), points).length;
    }
    return result;
}

Points CrossSections::middles(int outline, const Points& points) const {
    Points result = Points::Zero(3, line_count);
    for (int line = 0; line < line_count; ++line) {
        double length = 0.0;
        for (const auto triangle : patch_.triangles.colwise()) {
            const LevelPiece piece = level_within(triangle, levels_[at(outline)], level_of(line), points);
            result.col(line) += piece.length * piece.middle;
            length += piece.length;
        }
        if (length > 0.0) result.col(line) /= length;
    }
    return result;
}

Indices CrossSections::triangles(int outline, int line) const {
    Indices found;
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const Vector3 values = levels_[at(outline)](patch_.triangles.col(t));
        if (values.minCoeff() < level_of(line) && values.maxCoeff() >= level_of(line)) found.push_back(t);
    }
    return found;
}

}  // namespace fairing
