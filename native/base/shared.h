// A large value that copies of its owner share.
#pragma once

#include <concepts>
#include <functional>
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

// Made at the first access, by one thread at a time.
template <typename T>
class Deferred {
public:
    Deferred() : Deferred(T{}) {}
    Deferred(T value) : value_(std::make_shared<const T>(std::move(value))) {}  // NOLINT: as a T would
    explicit Deferred(std::function<T()> make) : make_(std::move(make)) {}

    const T& operator*() const {
        if (!value_) value_ = std::make_shared<const T>(make_());
        return *value_;
    }
    const T* operator->() const { return &**this; }

private:
    std::function<T()> make_;
    mutable std::shared_ptr<const T> value_;
};

}  // namespace fairing
