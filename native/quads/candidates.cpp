#include "quads/candidates.h"

#include <cstdlib>

#include "quads/closings.h"

namespace fairing {

namespace {

constexpr int most_poles = 7;       // whose orders are tried
constexpr int most_sides = 8;       // of a boundary along whose sides rows are tried one by one
constexpr int kept_each = 3;        // closings of each front and each order of poles
constexpr double most_quads = 3.0;  // as many as there is room for, and one more row

using Kinds = std::vector<PoleKind>;

// The least number of irregular vertices, of one sign, for the boundary's turning number. An odd number of edges
// needs the triangle. `extra` pairs of a three and a five shift rows.
Kinds kinds_for(int quarters, bool odd, int extra) {
    int threes = std::max(0, 4 - quarters) + extra;
    int fives = std::max(0, quarters - 4) + extra;
    if (odd && threes == 0)
        ++fives;
    else if (odd)
        --threes;
    Kinds kinds(static_cast<std::size_t>(threes), PoleKind::three);
    kinds.insert(kinds.end(), static_cast<std::size_t>(fives), PoleKind::five);
    if (odd) kinds.push_back(PoleKind::triangle);
    return kinds;
}

class Collection {
public:
    Collection(const HoleBoundary& boundary, const Indices& faces)
        : cells_(boundary.cells),
          odd_(boundary.places.cols() % 2 == 1),
          plain_(faces, boundary.places, boundary.angles) {
        quarters_ = plain_.quarters();
    }

    std::vector<CandidatePattern> best(int count) {
        for (int extra = 0; extra < 3 && candidates_.empty(); ++extra) collect(extra);
        std::stable_sort(candidates_.begin(), candidates_.end(),
                         [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; });
        std::vector<CandidatePattern> result;
        for (const Candidate& each : candidates_) {
            if (static_cast<int>(result.size()) == count) break;
            QuadFront front = fronts_[each.front];
            if (!front.place(each.closing.poles)) continue;
            std::optional<QuadPattern> filled = front.filled();
            if (!filled) continue;
            int poles = 0;
            int quarters = quarters_;
            for (const Pole& pole : each.closing.poles) {
                const bool inside = pole.triangle || fronts_[each.front].is_new(pole.at);
                poles += inside ? 1 : 0;
                quarters += inside ? 0 : pole.quarters;
            }
            result.push_back({std::move(*filled), each.misfit, poles, std::abs(4 - quarters)});
        }
        return result;
    }

private:
    struct Candidate {
        std::size_t front;
        Closing closing;
        double misfit;
    };

    void collect(int extra) {
        Kinds kinds = kinds_for(quarters_, odd_, extra);
        if (kinds.size() > most_poles) return;
        if (kinds.empty()) {
            const std::optional<QuadPattern> grid = plain_.filled();
            if (grid) add(plain_, {{}, 0.0, static_cast<int>(grid->quads.size())});
            return;
        }
        if (fronts_.empty()) make_fronts();
        std::sort(kinds.begin(), kinds.end());
        do {
            for (std::size_t k = 0; k < fronts_.size(); ++k) {
                for (Closing& each : closings(fronts_[k], kinds, kept_each)) add(k, std::move(each));
            }
        } while (std::next_permutation(kinds.begin(), kinds.end()));
    }

    void add(const QuadFront& front, Closing closing) {
        fronts_.push_back(front);
        add(fronts_.size() - 1, std::move(closing));
    }
    void add(std::size_t front, Closing closing) {
        const double size = std::log((fronts_[front].quad_count() + closing.cell_count) / cells_);
        const double misfit = closing.misfit + std::round(1e5 * size * size) * 1e-6;
        candidates_.push_back({front, std::move(closing), misfit});
    }

    // Rings all around, and rows along the sides between two convex corners.
    void make_fronts() {
        const double most = most_quads * cells_ + plain_.size();
        fronts_.push_back(plain_);
        const auto corners = std::count(plain_.faces().begin(), plain_.faces().end(), 1);
        for (int at = 0; at < plain_.size() && corners <= most_sides; ++at) {
            if (plain_.faces()[at] == 1) add_rows(at, most);
        }
        QuadFront front = plain_;
        for (int ring = 1; (front.add_ring() || front.add_short_row()) && front.quad_count() <= most; ++ring) {
            if (ring <= 8 || ring % 2 == 0) fronts_.push_back(front);
        }
    }

    void add_rows(int at, double most) {
        QuadFront front = plain_;
        for (int corner = at; front.add_row(corner) && front.quad_count() <= most;) {
            fronts_.push_back(front);
            corner = 0;  // where a row begins, once it is there
        }
    }

    double cells_;
    bool odd_;
    int quarters_ = 0;
    QuadFront plain_;
    std::vector<QuadFront> fronts_;
    std::vector<Candidate> candidates_;
};

// How many quads fit an angle.
Indices nearest_faces(const VectorX& angles) {
    Indices faces;
    for (const double angle : angles) faces.push_back(std::clamp(static_cast<int>(std::lround(angle / 90.0)), 1, 4));
    return faces;
}

int quarters_of(const Indices& faces) {
    int sum = 0;
    for (const int count : faces) sum += 2 - count;
    return sum;
}

// The same with the cheapest corners added or removed, so that the boundary turns by so many quarters.
Indices turned_faces(const VectorX& angles, Indices faces, int quarters) {
    for (int missing = quarters - quarters_of(faces); missing != 0;) {
        const int step = missing > 0 ? -1 : 1;
        int best = none;
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < static_cast<int>(faces.size()); ++k) {
            if (faces[k] + step < 1 || faces[k] + step > 4) continue;
            const double cost = angles_error(angles[k], faces[k] + step) - angles_error(angles[k], faces[k]);
            if (cost < least) {
                least = cost;
                best = k;
            }
        }
        if (best == none) return {};
        faces[best] += step;
        missing += step;
    }
    return faces;
}

double mean_error(const VectorX& angles, const Indices& faces) {
    double sum = 0.0;
    for (std::size_t k = 0; k < faces.size(); ++k) sum += angles_error(angles[static_cast<Eigen::Index>(k)], faces[k]);
    return sum / static_cast<double>(faces.size());
}

}  // namespace

std::vector<CandidatePattern> patterns_with_corners(const HoleBoundary& boundary, const Indices& faces, int count) {
    return Collection(boundary, faces).best(count);
}

std::vector<CandidatePattern> candidate_patterns(const HoleBoundary& boundary, int count) {
    const Indices nearest = nearest_faces(boundary.angles);
    std::vector<Indices> tried{Indices(nearest.size(), 2), nearest};
    for (const int quarters : {4, 3, 5, 2, 6, 1}) {
        Indices faces = turned_faces(boundary.angles, nearest, quarters);
        if (!faces.empty() && std::find(tried.begin(), tried.end(), faces) == tried.end())
            tried.push_back(std::move(faces));
    }
    std::vector<CandidatePattern> result;
    for (const Indices& faces : tried) {
        const double error = weight_of_angles * mean_error(boundary.angles, faces);
        for (CandidatePattern& each : patterns_with_corners(boundary, faces, count)) {
            each.misfit += error;
            result.push_back(std::move(each));
        }
    }
    return result;
}

}  // namespace fairing
