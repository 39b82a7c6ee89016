#include "linear/tree_solve.h"

namespace fairing {

FrontReach::FrontReach(const FrontTree& tree, const Indices& positions) : marks_(tree.nodes().size(), 0) {
    const Supernodes& nodes = tree.nodes();
    for (int position : positions) {
        int s = nodes.column_to_supernode[position];
        for (; s != none && marks_[s] == 0; s = nodes.parent[s]) marks_[s] = 1;
    }
}

}  // namespace fairing
