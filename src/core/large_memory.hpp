// Memory for pictures: what is large lies at the start of large pages. A system hands out 8 MB in four of them, where 2,000
// small ones take longer than drawing what stands there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

namespace chainreel {

// Bytes that are all written before they are read. Throws std::bad_alloc.
class RawBytes {
 public:
  RawBytes() : bytes_(nullptr, Free{0}) {}
  explicit RawBytes(std::size_t size);
  std::uint8_t* get() const { return bytes_.get(); }
  std::uint8_t& operator[](std::size_t i) const { return bytes_.get()[i]; }

 private:
  struct Free {
    std::size_t size;
    void operator()(std::uint8_t* memory) const;
  };
  std::unique_ptr<std::uint8_t, Free> bytes_;
};

// Bytes of pixels; each is 0 at first.
class PixelBytes {
 public:
  PixelBytes() = default;
  explicit PixelBytes(std::size_t size) : bytes_(size), size_(size) {
    if (size > 0) std::memset(data(), 0, size);
  }
  PixelBytes(const PixelBytes& other) : bytes_(other.size_), size_(other.size_) { copy(other); }
  PixelBytes(PixelBytes&& other) noexcept : bytes_(std::move(other.bytes_)), size_(std::exchange(other.size_, 0)) {}
  PixelBytes& operator=(const PixelBytes& other) {
    if (size_ != other.size_) return *this = PixelBytes(other);
    copy(other);
    return *this;
  }
  PixelBytes& operator=(PixelBytes&& other) noexcept {
    bytes_ = std::move(other.bytes_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  ~PixelBytes() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::uint8_t* data() { return bytes_.get(); }
  const std::uint8_t* data() const { return bytes_.get(); }
  std::uint8_t* begin() { return data(); }
  std::uint8_t* end() { return data() + size_; }
  const std::uint8_t* begin() const { return data(); }
  const std::uint8_t* end() const { return data() + size_; }
  std::uint8_t& operator[](std::size_t i) { return data()[i]; }
  const std::uint8_t& operator[](std::size_t i) const { return data()[i]; }
  friend bool operator==(const PixelBytes& a, const PixelBytes& b) {
    return a.size_ == b.size_ && (a.size_ == 0 || std::memcmp(a.data(), b.data(), a.size_) == 0);
  }

 private:
  void copy(const PixelBytes& other) {
    if (size_ > 0 && this != &other) std::memcpy(data(), other.data(), size_);
  }

  RawBytes bytes_;
  std::size_t size_ = 0;
};

}  // namespace chainreel
