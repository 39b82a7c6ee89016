// What a large run takes of the machine's memory.
#pragma once

#include <new>
#include <optional>
#include <string>

namespace fairing {

// More memory than there is: known before it is taken.
class MemoryShortage : public std::bad_alloc {
public:
    explicit MemoryShortage(std::string message) : message_(std::move(message)) {}
    [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

private:
    std::string message_;
};

// Bytes that a solve of so many free vertices takes at its peak, above the arrays given.
double memory_estimate(int free_count);

// Whether it pays to keep what such a call frees for itself until it ends (base/kept_memory.h).
bool keeps_memory(int most_free);

// Bytes that can still be had, swap space included; nothing where the system doesn't say (all but Linux).
std::optional<double> available_memory();

// Throws MemoryShortage where a large run is estimated to take more than `available`: a system that promises more
// memory than it has would end the process halfway. Others refuse at the allocation, as they do for small runs.
void check_memory(int free_count, std::optional<double> available);
// The same with what this machine says; small runs don't ask it.
void check_memory(int free_count);

}  // namespace fairing
