#include "fill/tube_start.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/direction.h"
#include "problem/willmore.h"

namespace fairing {

namespace {

constexpr double least_agreement = 0.5;  // of the directions into the gap; 0 around a flat ring, 1 at a tube

// One end of the tube.
struct End {
    Vector3 middle;
    Vector3 into;    // the gap; unit
    double outward;  // of the normals: above 0 where they point away from the axis
};

std::optional<End> end_at(const Patch& patch, const Indices& loop, const Points& points, const Points& normals) {
    const Points outwards = conormals(patch, points.rightCols(normals.cols()), normals);
    End end{Vector3::Zero(), Vector3::Zero(), 0.0};
    double total = 0.0;
    for (const int v : loop) {
        end.middle += points.col(v) / static_cast<double>(loop.size());
        end.into -= outwards.col(v - patch.free_count);
        total += outwards.col(v - patch.free_count).norm();
    }
    if (!(end.into.norm() > least_agreement * total)) return std::nullopt;
    end.into = direction(end.into);
    for (const int v : loop) end.outward += normals.col(v - patch.free_count).dot(points.col(v) - end.middle);
    return end;
}

// The cubic between the ends with frames along it. Columns: two across, then the tangent.
class Axis {
public:
    Axis(const End& first, const End& last) : begin_(first.middle), end_(last.middle) {
        // The speed with which a cubic comes nearest to an arc.
        const double cosine = std::clamp(-first.into.dot(last.into), -1.0, 1.0);
        const double speed = 2.0 * (end_ - begin_).norm() / (1.0 + std::sqrt(0.5 * (1.0 + cosine)));
        leaving_ = speed * first.into;
        arriving_ = -speed * last.into;
        follow();
    }

    [[nodiscard]] Vector3 place(double s) const {
        const double r = 1.0 - s;
        return r * r * (1.0 + 2.0 * s) * begin_ + s * s * (1.0 + 2.0 * r) * end_ +
               s * r * (r * leaving_ - s * arriving_);
    }

    [[nodiscard]] Eigen::Matrix3d frame(double s) const {
        const double along = std::clamp(s, 0.0, 1.0) * steps;
        const auto k = std::min(static_cast<std::size_t>(along), frames_.size() - 2);
        const double rest = along - static_cast<double>(k);
        const Eigen::Matrix3d mean = (1.0 - rest) * frames_[k] + rest * frames_[k + 1];
        Eigen::Matrix3d frame;
        frame.col(2) = direction(mean.col(2));
        frame.col(0) = direction(mean.col(0) - mean.col(0).dot(frame.col(2)) * frame.col(2));
        frame.col(1) = frame.col(2).cross(Vector3(frame.col(0)));
        return frame;
    }

    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (int k = 0; k < steps; ++k)
            sum += (place((k + 1.0) / steps) - place(static_cast<double>(k) / steps)).norm();
        return sum;
    }

private:
    static constexpr int steps = 128;

    [[nodiscard]] Vector3 tangent(double s) const {
        const double r = 1.0 - s;
        return direction(6.0 * s * r * (end_ - begin_) + r * (r - 2.0 * s) * leaving_ + s * (s - 2.0 * r) * arriving_);
    }

    void follow() {
        Vector3 across = tangent(0.0).unitOrthogonal();
        for (int k = 0; k <= steps; ++k) {
            const double s = static_cast<double>(k) / steps;
            if (k > 0) across = carried(across, s - 1.0 / steps, s);
            Eigen::Matrix3d& frame = frames_.emplace_back();
            frame.col(0) = across;
            frame.col(2) = tangent(s);
            frame.col(1) = frame.col(2).cross(across);
        }
    }

    [[nodiscard]] Vector3 carried(const Vector3& across, double from, double to) const {
        const auto mirrored = [](const Vector3& v, const Vector3& n) {
            return Vector3(v - 2.0 * n.dot(v) / n.squaredNorm() * n);
        };
        const Vector3 step = place(to) - place(from);
        if (!(step.squaredNorm() > 0.0)) return across;
        const Vector3 turn = tangent(to) - mirrored(tangent(from), step);
        const Vector3 once = mirrored(across, step);
        return turn.squaredNorm() > 0.0 ? mirrored(once, turn) : once;
    }

    Vector3 begin_;
    Vector3 end_;
    Vector3 leaving_;
    Vector3 arriving_;
    std::vector<Eigen::Matrix3d> frames_;
};

// A closed section in its frame, by the share of its length.
class Section {
public:
    // `loop`: counter-clockwise around the axis; it begins at `first`.
    Section(const Indices& loop, std::size_t first, const Points& points, const Axis& axis, double s) {
        const Eigen::Matrix3d frame = axis.frame(s);
        for (std::size_t k = 0; k <= loop.size(); ++k) {
            const Vector3 place = points.col(loop[(first + k) % loop.size()]);
            locals_.emplace_back(frame.transpose() * (place - axis.place(s)));
            const double step = k == 0 ? 0.0 : (locals_[k] - locals_[k - 1]).norm();
            shares_.push_back(k == 0 ? 0.0 : shares_.back() + step);
        }
        for (double& share : shares_) share /= shares_.back();
    }

    [[nodiscard]] Vector3 at_share(double u) const {
        const auto after = std::upper_bound(shares_.begin() + 1, shares_.end() - 1, u);
        const auto k = static_cast<std::size_t>(after - shares_.begin());
        const double part = (u - shares_[k - 1]) / std::max(shares_[k] - shares_[k - 1], least_share);
        return (1.0 - part) * locals_[k - 1] + part * locals_[k];
    }
    [[nodiscard]] double share(std::size_t k) const { return shares_[k]; }

private:
    static constexpr double least_share = 1e-12;
    std::vector<Vector3> locals_;
    std::vector<double> shares_;
};

double distance(const Section& a, const Section& b, int samples) {
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double u = static_cast<double>(k) / samples;
        sum += (a.at_share(u) - b.at_share(u)).squaredNorm();
    }
    return sum;
}

// Begun where it lies best before the other one.
std::size_t best_beginning(const Indices& loop, const Points& points, const Axis& axis, const Section& other) {
    constexpr int samples = 32;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t first = 0; first < loop.size(); ++first) {
        const double here = distance(other, Section(loop, first, points, axis, 1.0), samples);
        if (here >= least) continue;
        least = here;
        best = first;
    }
    return best;
}

// A closed row of vertices with their shares of the way around; the first one has 0.
struct Row {
    Indices vertices;
    std::vector<double> shares;
};

void join(const Row& below, const Row& above, std::vector<Eigen::Vector3i>& triangles) {
    std::size_t a = 0;
    std::size_t b = 0;
    const auto next = [](const Row& row, std::size_t k) { return k + 1 < row.shares.size() ? row.shares[k + 1] : 1.0; };
    const auto vertex = [](const Row& row, std::size_t k) { return row.vertices[k % row.vertices.size()]; };
    while (a < below.vertices.size() || b < above.vertices.size()) {
        const bool advances_below =
            b == above.vertices.size() || (a < below.vertices.size() && next(below, a) <= next(above, b));
        if (advances_below) {
            triangles.emplace_back(vertex(below, a), vertex(below, a + 1), vertex(above, b));
            ++a;
        } else {
            triangles.emplace_back(vertex(below, a), vertex(above, b + 1), vertex(above, b));
            ++b;
        }
    }
}

Row row_of(const Indices& loop, std::size_t first, const Section& section, int added) {
    Row row;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        row.vertices.push_back(added + loop[(first + k) % loop.size()]);
        row.shares.push_back(section.share(k));
    }
    return row;
}

struct Resolution {
    int around;
    int along;
};

// About as long as wide.
Resolution resolution(const std::vector<Indices>& loops, const Points& points, const Axis& axis) {
    const auto around = static_cast<int>(std::clamp<std::size_t>(std::max(loops[0].size(), loops[1].size()), 16, 48));
    double girth = 0.0;
    for (const Indices& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k)
            girth += 0.5 * (points.col(loop[k]) - points.col(loop[(k + 1) % loop.size()])).norm();
    }
    const int along = static_cast<int>(std::lround(std::min(axis.length() * around / girth, 200.0)));
    return {around, std::max(along, 2)};
}

// Rows of vertices between two sections, joined by triangles.
class Sweep {
public:
    Sweep(const std::vector<Indices>& loops, const Points& points, const Axis& axis)
        : loops_(loops),
          axis_(axis),
          size_(resolution(loops, points, axis)),
          below_(loops[0], 0, points, axis, 0.0),
          begin_(best_beginning(loops[1], points, axis, below_)),
          above_(loops[1], begin_, points, axis, 1.0) {}

    [[nodiscard]] TubeMesh mesh() const {
        const int added = size_.around * (size_.along - 1);
        TubeMesh result{Points(3, added), {}};
        std::vector<Eigen::Vector3i> triangles;
        Row last = row_of(loops_[0], 0, below_, added);
        for (int j = 1; j < size_.along; ++j) {
            Row row = row_between(j, result.points);
            join(last, row, triangles);
            last = std::move(row);
        }
        join(last, row_of(loops_[1], begin_, above_, added), triangles);
        result.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
        for (std::size_t t = 0; t < triangles.size(); ++t)
            result.triangles.col(static_cast<Eigen::Index>(t)) = triangles[t];
        return result;
    }

private:
    Row row_between(int j, Points& points) const {
        const double s = static_cast<double>(j) / size_.along;
        const Vector3 place = axis_.place(s);
        const Eigen::Matrix3d frame = axis_.frame(s);
        Row row;
        for (int k = 0; k < size_.around; ++k) {
            const double u = static_cast<double>(k) / size_.around;
            const int v = size_.around * (j - 1) + k;
            points.col(v) = place + frame * ((1.0 - s) * below_.at_share(u) + s * above_.at_share(u));
            row.vertices.push_back(v);
            row.shares.push_back(u);
        }
        return row;
    }

    const std::vector<Indices>& loops_;
    const Axis& axis_;
    Resolution size_;
    Section below_;
    std::size_t begin_;  // on the second loop
    Section above_;
};

}  // namespace

std::optional<TubeMesh> tube_start(const Patch& bare, const Points& points, const Points& normals) {
    std::vector<Indices> loops = bare.loops();
    if (loops.size() != 2 || loops[0].size() + loops[1].size() != static_cast<std::size_t>(points.cols()))
        return std::nullopt;
    const auto first = end_at(bare, loops[0], points, normals);
    const auto last = end_at(bare, loops[1], points, normals);
    if (!first || !last || !(first->outward * last->outward > 0.0)) return std::nullopt;
    const Axis axis(*first, *last);
    std::reverse(loops[1].begin(), loops[1].end());  // around the axis as the first one
    return Sweep(loops, points, axis).mesh();
}

}  // namespace fairing
