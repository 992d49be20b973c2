#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

#include "memory/memory.h"

namespace mlcp {

/// A vector of plain values over the caller's memory. Its capacity only grows until trim(), so that a step as large as an
/// earlier one allocates nothing. After reserve(n), no call that stays within n entries can fail.
template <class T>
class Array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit Array(const Memory& memory) : memory_(memory) {}
  Array(const Array& other) : memory_(other.memory_) { assign(other.span()); }
  Array(Array&& other) noexcept : memory_(other.memory_) { swap(other); }
  Array& operator=(const Array& other) {
    if (this != &other) assign(other.span());
    return *this;
  }
  Array& operator=(Array&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Array() { memory_.release(data_, capacity_ * sizeof(T)); }

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T& back() { return data_[size_ - 1]; }
  const T& back() const { return data_[size_ - 1]; }
  std::span<T> span() { return {data_, size_}; }
  std::span<const T> span() const { return {data_, size_}; }

  void reserve(std::size_t n) {
    if (n > capacity_) reallocate(std::max(n, capacity_ + capacity_ / 2));
  }
  /// New entries are uninitialised.
  void resize(std::size_t n) {
    reserve(n);
    size_ = n;
  }
  void resize(std::size_t n, T value) {
    const std::size_t old = size_;
    resize(n);
    if (n > old) std::fill(data_ + old, data_ + n, value);
  }
  void assign(std::size_t n, T value) {
    resize(n);
    std::fill(data_, data_ + n, value);
  }
  void assign(std::span<const T> values) {
    resize(values.size());
    if (!values.empty()) std::memcpy(data_, values.data(), values.size() * sizeof(T));
  }
  void append(std::span<const T> values) {
    const std::size_t before = size_;
    resize(before + values.size());
    if (!values.empty()) std::memcpy(data_ + before, values.data(), values.size() * sizeof(T));
  }
  void push_back(T value) {
    reserve(size_ + 1);
    data_[size_++] = value;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  void trim() {
    if (capacity_ == size_) return;
    if (size_ == 0) {
      memory_.release(data_, capacity_ * sizeof(T));
      data_ = nullptr;
      capacity_ = 0;
    } else {
      reallocate(size_);
    }
  }
  void swap(Array& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

 private:
  void reallocate(std::size_t n) {
    if (n > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
    data_ = static_cast<T*>(memory_.reallocate(data_, capacity_ * sizeof(T), n * sizeof(T)));
    capacity_ = n;
  }

  Memory memory_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace mlcp
