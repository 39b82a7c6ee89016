// Memory that a large call frees and takes again.
#pragma once

namespace fairing {

// While one that is wanted lives, memory that is freed stays with the process. Otherwise the GNU allocator gives arrays
// of 32 MB and more back to the system at once, and whoever takes memory next gets fresh pages, each of which the
// system clears and maps first. At the end all that is free goes back to the system. Several may live at once, on any
// threads. Other allocators than the GNU C library's are left as they are.
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
