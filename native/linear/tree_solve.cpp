#include "linear/tree_solve.h"

namespace fairing {

FrontReach::FrontReach(const FrontTree& tree, const Indices& positions) : marks_(at(tree.nodes().size()), 0) {
    const Supernodes& nodes = tree.nodes();
    for (int position : positions) {
        int s = nodes.column_to_supernode[at(position)];
        for (; s != none && marks_[at(s)] == 0; s = nodes.parent[at(s)]) marks_[at(s)] = 1;
    }
}

}  // namespace fairing
