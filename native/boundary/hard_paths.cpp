#include "boundary/hard_paths.h"

#include <set>

#include "mesh/nearest_first.h"

namespace fairing {

namespace {

constexpr double least_hard = 0.75;  // share of a path's length that must be hard
constexpr double hard_cost = 1e-3;   // weight of a hard edge's length: paths leave hard edges only where they must

// From one vertex to all within reach.
struct Tree {
    std::vector<char> reached;
    VectorX distance;
    Indices before;
    Indices by;  // the edge from there
};

class Graph {
public:
    Graph(const View<Points>& points, const VertexPairs& edges, const VertexPairs& hard)
        : edges_(edges), at_(static_cast<std::size_t>(points.cols())) {
        double hard_length = 0.0;
        double total = 0.0;
        for (const auto& [a, b] : edges) {
            const double length = (points.col(a) - points.col(b)).norm();
            const bool is_hard = std::ranges::binary_search(hard, std::array<int, 2>{a, b});
            for (const int v : {a, b}) at_[v].push_back(static_cast<int>(lengths_.size()));
            lengths_.push_back(length);
            soft_.push_back(is_hard ? 0.0 : length);
            total += 2.0 * length;
            if (is_hard) hard_length += length;
        }
        // The longest soft part that any accepted path can have.
        const double most = (1.0 / least_hard - 1.0) * hard_length;
        farthest_ = (1.0 + hard_cost) * most + hard_cost * total;
    }

    // Edges of the paths from each end to the vertex where they meet; none where too little of them is hard.
    [[nodiscard]] std::set<int> path(const Indices& ends) const {
        std::vector<Tree> trees;
        trees.reserve(ends.size());
        const bool is_pair = ends.size() == 2;
        for (std::size_t k = 0; k < (is_pair ? 1 : ends.size()); ++k)
            trees.push_back(tree(ends[k], is_pair ? ends[1] : none));
        const int meeting = is_pair ? (trees[0].reached[ends[1]] != 0 ? ends[1] : none) : nearest(trees);
        if (meeting == none) return {};
        std::set<int> found;
        double length = 0.0;
        double soft = 0.0;
        for (const Tree& each : trees) {
            for (int v = meeting; each.before[v] != none; v = each.before[v]) {
                found.insert(each.by[v]);
                length += lengths_[each.by[v]];
                soft += soft_[each.by[v]];
            }
        }
        return soft <= (1.0 - least_hard) * length ? found : std::set<int>{};
    }

private:
    [[nodiscard]] Tree tree(int start, int target) const {
        const auto count = at_.size();
        constexpr double never = std::numeric_limits<double>::infinity();  // not reached yet
        Tree found{std::vector<char>(count, 0), {}, Indices(count, none), Indices(count, none)};
        NearestFirst ahead(VectorX::Constant(static_cast<Eigen::Index>(count), never));
        ahead.lower(start, 0.0);
        for (int v = ahead.next(); v != none && !(ahead[v] > farthest_); v = ahead.next()) {
            found.reached[v] = 1;
            if (v == target) break;
            for (const int edge : at_[v]) {
                const int other = edges_[edge][0] == v ? edges_[edge][1] : edges_[edge][0];
                if (!ahead.lower(other, ahead[v] + (soft_[edge] + hard_cost * lengths_[edge]))) continue;
                found.before[other] = v;
                found.by[other] = edge;
            }
        }
        found.distance = std::move(ahead).take();
        return found;
    }

    // The vertex that all trees reach with the least sum of paths.
    [[nodiscard]] int nearest(const std::vector<Tree>& trees) const {
        int best = none;
        double least = std::numeric_limits<double>::infinity();
        for (int v = 0; v < static_cast<int>(at_.size()); ++v) {
            double sum = 0.0;
            for (const Tree& each : trees) sum += each.reached[v] != 0 ? each.distance[v] : least;
            if (!(sum < least)) continue;
            least = sum;
            best = v;
        }
        return best;
    }

    const VertexPairs& edges_;
    std::vector<Indices> at_;  // edges at each vertex
    std::vector<double> lengths_;
    std::vector<double> soft_;  // of each edge: its length, or 0 where it is hard
    double farthest_ = 0.0;
};

}  // namespace

VertexPairs hard_paths(const View<Points>& points, const VertexPairs& edges, const VertexPairs& hard,
                       const std::vector<Indices>& ends) {
    const Graph graph(points, edges, hard);
    std::set<int> found;
    for (const Indices& each : ends) found.merge(graph.path(each));
    VertexPairs result;
    for (const int edge : found) result.push_back(edges[edge]);
    return result;
}

}  // namespace fairing
