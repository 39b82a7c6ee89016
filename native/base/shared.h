// A large value that copies of its owner share.
#pragma once

#include <concepts>
#include <memory>
#include <utility>

namespace fairing {

// Never changes; another one may be assigned.
template <typename T>
class Shared {
public:
    Shared() : Shared(T{}) {}
    template <std::convertible_to<T> U>
        requires(!std::same_as<std::remove_cvref_t<U>, Shared>)
    Shared(U&& value) : value_(std::make_shared<const T>(std::forward<U>(value))) {}  // NOLINT: as a T would

    operator const T&() const { return *value_; }  // NOLINT: as a T would
    const T& operator*() const { return *value_; }

private:
    std::shared_ptr<const T> value_;
};

}  // namespace fairing
