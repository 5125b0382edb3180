#include "core/large_memory.hpp"

#include <sys/mman.h>

#include <new>

namespace chainreel {
namespace {

constexpr std::size_t kPage = 4096, kLargePage = std::size_t(1) << 21;

bool fills_a_large_page(std::size_t bytes) {
  return bytes > kLargePage / 2;
}

// The last large page is taken whole where more than half of it is needed: 1920x1080 pixels take four but for 0.1 MB.
std::size_t in_pages(std::size_t bytes) {
  const std::size_t whole = bytes / kLargePage * kLargePage;
  return fills_a_large_page(bytes - whole) ? whole + kLargePage : bytes;
}

void* allocated(std::size_t size) {
  if (!fills_a_large_page(size)) return ::operator new(size);
  const std::size_t taken = in_pages(size);
  void* memory = ::operator new(taken, std::align_val_t(kLargePage));
  // A refusal leaves small pages, which serve as well.
  madvise(memory, taken / kPage * kPage, MADV_HUGEPAGE);
  return memory;
}

}  // namespace

RawBytes::RawBytes(std::size_t size) : bytes_(static_cast<std::uint8_t*>(allocated(size)), Free{size}) {}

void RawBytes::Free::operator()(std::uint8_t* memory) const {
  if (fills_a_large_page(size))
    ::operator delete(memory, std::align_val_t(kLargePage));
  else
    ::operator delete(memory);
}

}  // namespace chainreel
