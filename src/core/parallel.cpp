#include "core/parallel.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/plain_numbers.hpp"

namespace chainreel {

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& run) {
  for_each_index_with_tools(count, threads, [&run]() -> RunIndex { return std::ref(run); });
}

void for_each_index_with_tools(std::size_t count, int threads, const std::function<RunIndex()>& begin) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr problem;
  std::mutex lock;
  const auto work = [&] {
    const PlainNumbers plain;
    try {
      const RunIndex run = begin();
      for (std::size_t i = next++; i < count; i = next++) run(i);
    } catch (...) {
      const std::lock_guard guard(lock);
      if (!problem) problem = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int k = 1; k < threads && std::size_t(k) < count; ++k) others.emplace_back(work);
    } catch (const std::system_error&) {
      // The system gives no more threads: those that there are do all of it.
    } catch (...) {
      next = count;
      throw;
    }
    work();
  }
  if (problem) std::rethrow_exception(problem);
}

}  // namespace chainreel
