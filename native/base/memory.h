// How much of the machine's memory a large run takes.
#pragma once

#include <new>
#include <optional>
#include <string>

namespace fairing {

// Thrown before a run that would take more memory than there is.
class MemoryShortage : public std::bad_alloc {
public:
    explicit MemoryShortage(std::string message) : message_(std::move(message)) {}
    [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

private:
    std::string message_;
};

// Bytes that a solve of so many free vertices takes at its peak, above the arrays given.
double memory_estimate(int free_count);

// Bytes that can still be had, swap space included; nothing where the system doesn't report it (all but Linux).
std::optional<double> available_memory();

// Throws MemoryShortage where a large run is estimated to take more than `available`: a system that promises more
// memory than it has would end the process halfway. Others refuse at the allocation, as they do for small runs.
void check_memory(int free_count, std::optional<double> available);
// The same with this machine's free memory, which small runs don't query.
void check_memory(int free_count);

}  // namespace fairing
