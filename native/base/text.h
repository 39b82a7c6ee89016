// Wording of messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostic.h"

namespace fairing {

// The number with the phrase that goes with it.
inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

// About these elements, whose number is the figure of that name.
inline Diagnostic about(Code code, std::string message, Indices elements, ElementKind kind, const char* figure) {
    const double count = size_of(elements);
    return {code, std::move(message), std::move(elements), kind, {{figure, count}}};
}

}  // namespace fairing
