// Memory that a large call frees and takes again.
#pragma once

namespace fairing {

// While one that is wanted lives, freed memory stays with the process. Otherwise the GNU allocator returns arrays of 32
// MB and more to the system at once, which has to clear and map fresh pages for the next array. The last one returns
// all free memory to the system. Several may live at once, on any threads. Has no effect with other allocators.
class KeptMemory {
public:
    explicit KeptMemory(bool wanted);
    ~KeptMemory();
    KeptMemory(const KeptMemory&) = delete;
    KeptMemory& operator=(const KeptMemory&) = delete;

private:
    const bool wanted_;
};

}  // namespace fairing
