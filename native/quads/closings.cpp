#include "quads/closings.h"

#include <complex>
#include <unordered_map>
#include <unordered_set>

#include "base/progress.h"

namespace fairing {

namespace {

constexpr double most_tries = 20'000.0;  // of the last pole but one, for one order of poles
constexpr double same_misfit = 1e-6;     // misfits nearer to each other are equal, so that roundoff doesn't choose

int quarters_of(PoleKind kind) { return kind == PoleKind::five ? -1 : 1; }

std::int64_t key_of(const Lattice& p) { return static_cast<std::int64_t>(p.x) * 4294967296LL + p.y; }

class Search {
public:
    Search(const QuadFront& front, const std::vector<PoleKind>& kinds, int count)
        : front_(front), walk_(front.walk()), kinds_(kinds), count_(count) {
        int turned = 0;
        for (const PoleKind kind : kinds) {
            turned_.push_back(turned);
            turned += quarters_of(kind);
        }
        wanted_ = Lattice{} - walk_.back().turned(turned);
        for (const PoleKind kind : kinds) places_.push_back(places_for(kind));
        const std::size_t last = kinds.size() - 1;
        for (const int at : places_[last]) by_term_[key_of(term(last, at))].push_back(at);
    }

    std::vector<Closing> found() {
        chosen_.clear();
        choose(0, Lattice{}, -1);
        return std::move(best_);
    }

private:
    [[nodiscard]] Indices places_for(PoleKind kind) const {
        Indices places;
        const int count = front_.size();
        for (int at = 0; at < count; ++at) {
            const bool fits = kind == PoleKind::triangle
                                  ? front_.faces()[at] > 1 && front_.faces()[(at + 1) % count] > 1 && at + 1 < count
                                  : front_.cost_of_turning(at, quarters_of(kind)).has_value();
            if (fits) places.push_back(at);
        }
        return places;
    }

    // The shift of the end of the walk by an irregular vertex.
    [[nodiscard]] Lattice term(std::size_t which, int at) const {
        const Lattice here = walk_[at];
        const Lattice sum = kinds_[which] == PoleKind::triangle ? walk_[at + 1] - here.turned(1)
                                                                : here - here.turned(quarters_of(kinds_[which]));
        return sum.turned(turned_[which]);
    }

    // The stride between positions tried for a pole before the last two, which bounds the number of tries.
    [[nodiscard]] std::size_t stride(std::size_t which) const {
        const double open = static_cast<double>(kinds_.size()) - 2.0;
        const double tries = std::max(6.0, std::pow(std::tgamma(open + 1.0) * most_tries / front_.size(), 1.0 / open));
        return std::max<std::size_t>(
            1, static_cast<std::size_t>(std::ceil(static_cast<double>(places_[which].size()) / tries)));
    }

    void choose(std::size_t which, const Lattice& sum, int after) {
        if (which + 1 == kinds_.size()) {
            const auto found = by_term_.find(key_of(wanted_ - sum));
            if (found == by_term_.end()) return;
            for (const int at : found->second) {
                if (at > after) keep(at);
            }
            return;
        }
        const std::size_t step = which + 2 < kinds_.size() ? stride(which) : 1;
        for (std::size_t k = 0; k < places_[which].size(); k += step) {
            const int at = places_[which][k];
            if (at <= after) continue;
            chosen_.push_back(at);
            choose(which + 1, sum + term(which, at), at);
            chosen_.pop_back();
        }
    }

    void keep(int last);
    [[nodiscard]] double misfit(const std::vector<Lattice>& walk) const;

    const QuadFront& front_;
    std::vector<Lattice> walk_;
    const std::vector<PoleKind>& kinds_;
    std::size_t count_;
    Indices turned_;  // of each pole: quarters of those before it
    Lattice wanted_;
    std::vector<Indices> places_;
    std::unordered_map<std::int64_t, Indices> by_term_;
    Indices chosen_;
    std::vector<Closing> best_;
};

// The best fit of positions w by a z + b with complex a, z those on the lattice.
double Search::misfit(const std::vector<Lattice>& walk) const {
    using Complex = std::complex<double>;
    const double count = front_.size();
    Complex mean_z, mean_w, mixed;
    double spread_z = 0.0;
    double spread_w = 0.0;
    for (int k = 0; k < front_.size(); ++k) {
        const Complex z(walk[k].x, walk[k].y);
        const Complex w(front_.places()[k].x(), front_.places()[k].y());
        mean_z += z / count;
        mean_w += w / count;
        mixed += std::conj(z) * w;
        spread_z += std::norm(z);
        spread_w += std::norm(w);
    }
    mixed -= count * std::conj(mean_z) * mean_w;
    spread_z -= count * std::norm(mean_z);
    spread_w -= count * std::norm(mean_w);
    if (!(spread_z > 0.0) || !(spread_w > 0.0)) return 1.0;
    return 1.0 - std::norm(mixed) / (spread_z * spread_w);
}

// The walk with its poles; the lattice point that a triangle adds is kept apart.
struct Closed {
    std::vector<Lattice> own;
    std::optional<Lattice> added;
    Lattice end;
};

std::optional<Closed> closed(const Indices& faces, const std::vector<Pole>& poles) {
    Closed result;
    int heading = 0;
    auto pole = poles.begin();
    bool after_triangle = false;
    for (int k = 0; k < static_cast<int>(faces.size()); ++k) {
        int left = faces[k] - (after_triangle ? 1 : 0);
        after_triangle = false;
        for (; pole != poles.end() && pole->at == k; ++pole) {
            left -= pole->quarters;
            after_triangle = pole->triangle;
        }
        if (left < 1) return std::nullopt;
        heading += 2 - left;
        result.own.push_back(result.end);
        result.end = result.end + Lattice{1, 0}.turned(heading);
        if (!after_triangle) continue;
        result.added = result.end;
        result.end = result.end + Lattice{1, 0}.turned(--heading);
    }
    return result;
}

int twice_area(const std::vector<Lattice>& polygon) {
    int sum = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Lattice& next = polygon[(k + 1) % polygon.size()];
        sum += polygon[k].x * next.y - next.x * polygon[k].y;
    }
    return sum;
}

void Search::keep(int last) {
    Closing closing;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
        const int at = k < chosen_.size() ? chosen_[k] : last;
        closing.poles.push_back({at, quarters_of(kinds_[k]), kinds_[k] == PoleKind::triangle});
    }
    const std::optional<Closed> walk = closed(front_.faces(), closing.poles);
    if (!walk || !(walk->end == Lattice{})) return;
    closing.misfit = misfit(walk->own);
    const double share = weight_of_angles / front_.boundary_count();
    for (const Pole& pole : closing.poles) {
        if (!pole.triangle) closing.misfit += share * front_.cost_of_turning(pole.at, pole.quarters).value_or(0.0);
    }
    closing.misfit = std::round(closing.misfit / same_misfit) * same_misfit;
    if (best_.size() == count_ && closing.misfit >= best_.back().misfit) return;
    std::unordered_set<std::int64_t> seen;
    for (const Lattice& each : walk->own) {
        if (!seen.insert(key_of(each)).second) return;
    }
    std::vector<Lattice> polygon = walk->own;
    if (walk->added) {
        if (!seen.insert(key_of(*walk->added)).second) return;
        const auto triangle =
            std::find_if(closing.poles.begin(), closing.poles.end(), [](const Pole& pole) { return pole.triangle; });
        polygon.insert(polygon.begin() + triangle->at + 1, *walk->added);
    }
    closing.cell_count = twice_area(polygon) / 2;
    if (closing.cell_count <= 0) return;
    const auto place = std::upper_bound(best_.begin(), best_.end(), closing,
                                        [](const Closing& a, const Closing& b) { return a.misfit < b.misfit; });
    best_.insert(place, closing);
    if (best_.size() > count_) best_.pop_back();
}

}  // namespace

std::vector<Closing> closings(const QuadFront& front, const std::vector<PoleKind>& kinds, int count) {
    checkpoint();
    return Search(front, kinds, count).found();
}

}  // namespace fairing
