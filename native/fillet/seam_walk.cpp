#include "fillet/seam_walk.h"

#include <map>

namespace fairing {

namespace {

constexpr double same = 1e-6;  // of a walk's length: roundoff of feet

Indices partners(const SeamMesh& mesh) {
    std::map<int, Indices> sides;
    for (int h = 0; h < mesh.half_edge_count(); ++h) sides[mesh.edge[h]].push_back(h);
    Indices result(mesh.edge.size(), none);
    for (const auto& [edge, at] : sides) {
        if (at.size() != 2 || mesh.tail(at[0]) == mesh.tail(at[1])) continue;
        result[at[0]] = at[1];
        result[at[1]] = at[0];
    }
    return result;
}

}  // namespace

SeamWalks::SeamWalks(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line)
    : mesh_(mesh),
      distance_(distance),
      line_(line),
      partner_(partners(mesh)),
      out_(mesh.points.cols()),
      sector_(mesh.edge.size(), none),
      at_(mesh.edge.size(), At{none, 0}) {
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] != none && mesh.twin[h] != none) out_[mesh.tail(h)].push_back(h);
    }
    make_arcs();
    for (const SeamArc& arc : arcs_) {
        walk_from(arc.half_edges.front());
        walk_from(mesh.twin[arc.half_edges.back()]);
    }
    add_line();
}

void SeamWalks::make_arcs() {
    std::vector<char> used(mesh_.edge.size(), 0);
    for (const bool from_meetings : {true, false}) {
        for (int v = 0; v < static_cast<int>(out_.size()); ++v) {
            if (from_meetings && !is_meeting(v)) continue;
            for (const int h : out_[v]) {
                if (used[h] != 0) continue;
                add_arc(h);
                for (const int each : arcs_.back().half_edges) used[each] = used[mesh_.twin[each]] = 1;
            }
        }
    }
}

void SeamWalks::add_arc(int first) {
    SeamArc arc{{first}, {0.0, mesh_.length[first]}, false};
    while (!is_meeting(mesh_.head(arc.half_edges.back()))) {
        const int last = arc.half_edges.back();
        const Indices& out = out_[mesh_.head(last)];
        const int next = out[0] == mesh_.twin[last] ? out[1] : out[0];
        arc.closed = next == first;
        if (arc.closed) break;
        arc.half_edges.push_back(next);
        arc.ways.push_back(arc.ways.back() + mesh_.length[next]);
    }
    arcs_.push_back(arc);
}

// The seam that follows a half-edge clockwise around its head.
int SeamWalks::around(int half_edge, bool& walled) {
    Indices sectors;
    int g = SeamMesh::next(half_edge);
    for (int step = 0; step <= mesh_.half_edge_count(); ++step) {
        if (mesh_.seam[g] != none && mesh_.twin[g] != none) {
            sectors.push_back(g);
            for (const int sector : sectors) sector_[sector] = g;
            return g;
        }
        if (mesh_.twin[g] == none) {
            walled = true;
            sectors.push_back(g);
        }
        if (partner_[g] != none) {
            g = SeamMesh::next(partner_[g]);
            continue;
        }
        g = mesh_.twin[half_edge];  // over a gap: on from the other border there
        for (int turned = 0; partner_[SeamMesh::previous(g)] != none; ++turned) {
            g = partner_[SeamMesh::previous(g)];
            if (turned > mesh_.half_edge_count()) throw NoRows();
        }
    }
    throw NoRows();
}

void SeamWalks::walk_from(int first) {
    if (at_[first].walk != none) return;
    SeamWalk walk;
    walk.ways.push_back(0.0);
    for (int h = first; walk.half_edges.empty() || h != first;) {
        if (at_[h].walk != none) throw NoRows();  // two ways lead on to one
        at_[h] = {static_cast<int>(walks_.size()), static_cast<int>(walk.half_edges.size())};
        walk.half_edges.push_back(h);
        walk.ways.push_back(walk.ways.back() + mesh_.length[h]);
        bool walled = false;
        h = around(h, walled);
        walk.walled.push_back(walled ? 1 : 0);
    }
    std::rotate(walk.walled.begin(), walk.walled.end() - 1, walk.walled.end());
    walks_.push_back(walk);
}

double SeamWalks::way_of(int point, int& walk) const {
    const SeamFoot foot = distance_.foot(line_.points[point].triangle, line_.points[point].weights);
    const int h = foot.half_edge == none || !foot.corner ? foot.half_edge : sector_[foot.half_edge];
    if (h == none || at_[h].walk == none) throw NoRows();
    walk = at_[h].walk;
    return walks_[walk].ways[at_[h].index] + (foot.corner ? 0.0 : foot.along);
}

// The line runs against the walks, since the fillet lies on its left.
void SeamWalks::add_line() {
    Indices after(line_.points.size(), none);
    Indices before(line_.points.size(), none);
    for (int s = 0; s < static_cast<int>(line_.segments.size()); ++s) {
        const auto [from, to, triangle] = line_.segments[s];
        if (before[from] != none || after[to] != none) throw NoRows();
        before[from] = after[to] = s;
    }
    std::vector<char> used(line_.points.size(), 0);
    for (const bool open : {true, false}) {
        for (int p = 0; p < static_cast<int>(used.size()); ++p) {
            if (used[p] != 0 || after[p] == none || (open && before[p] != none)) continue;
            Indices chain{p};
            Indices segments;
            used[p] = 1;
            while (after[chain.back()] != none) {
                segments.push_back(after[chain.back()]);
                const int next = line_.segments[segments.back()].from;
                if (used[next] != 0) break;
                used[next] = 1;
                chain.push_back(next);
            }
            add_chain(chain, segments, chain.size() == segments.size());
        }
    }
    for (const SeamWalk& walk : walks_) {
        if (walk.points.empty()) throw NoRows();
    }
}

void SeamWalks::add_chain(const Indices& chain, const Indices& segments, bool closed) {
    std::vector<double> at;
    int own = none;
    for (const int p : chain) {
        int walk = none;
        at.push_back(way_of(p, walk));
        if (own != none && walk != own) throw NoRows();
        own = walk;
    }
    const double length = walks_[own].ways.back();
    const int count = static_cast<int>(chain.size());
    int first = 0;
    for (double& way : at) way = closed && way > (1.0 - same) * length ? 0.0 : way;
    const auto begins_anew = [&](int k) { return at[k] < at[(k + count - 1) % count] - 0.5 * length; };
    while (closed && first < count - 1 && !begins_anew(first)) ++first;
    if (!begins_anew(first)) first = 0;
    SeamWalk part;
    for (int k = 0; k < count; ++k) {
        const int from = (first + k) % count;
        if (k > 0 && begins_anew(from)) {  // over the walk's begin, which is its end
            insert(part, walks_[own]);
            part = {};
        }
        part.points.push_back(chain[from]);
        part.segments.push_back(from < static_cast<int>(segments.size()) ? segments[from] : none);
        part.at.push_back(part.at.empty() ? at[from] : std::max(at[from], part.at.back()));
        if (part.at.back() > at[from] + same * length) throw NoRows();
    }
    insert(part, walks_[own]);
}

void SeamWalks::insert(const SeamWalk& part, SeamWalk& walk) {
    const double near = same * walk.ways.back();
    const double middle = 0.5 * (part.at.front() + part.at.back());
    const auto place = std::lower_bound(walk.at.begin(), walk.at.end(), middle) - walk.at.begin();
    if ((place > 0 && walk.at[place - 1] > part.at.front() + near) ||
        (place < std::ssize(walk.at) && walk.at[place] < part.at.back() - near))
        throw NoRows();
    walk.points.insert(walk.points.begin() + place, part.points.begin(), part.points.end());
    walk.segments.insert(walk.segments.begin() + place, part.segments.begin(), part.segments.end());
    walk.at.insert(walk.at.begin() + place, part.at.begin(), part.at.end());
}

}  // namespace fairing
