#include "core/loaded_libraries.hpp"

#include <elf.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>

#include "core/hash.hpp"

namespace chainreel {
namespace {

std::string hexadecimal(const unsigned char* bytes, std::size_t count) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += {kDigits[bytes[k] >> 4], kDigits[bytes[k] & 15]};
  return text;
}

// Notes are a head, a name and what is told, each filled up to whole words of four bytes.
std::string build_id(const dl_phdr_info& library) {
  const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t(3); };
  for (int i = 0; i < library.dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = library.dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const auto* at = reinterpret_cast<const unsigned char*>(library.dlpi_addr + part.p_vaddr);
    for (const unsigned char* const end = at + part.p_memsz; at + sizeof(ElfW(Nhdr)) <= end;) {
      ElfW(Nhdr) head;
      std::memcpy(&head, at, sizeof head);
      const unsigned char* const name = at + sizeof head;
      const unsigned char* const told = name + padded(head.n_namesz);
      if (told + head.n_descsz > end) break;
      if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0)
        return hexadecimal(told, head.n_descsz);
      at = told + padded(head.n_descsz);
    }
  }
  return "";
}

struct Search {
  std::span<const std::string_view> beginnings;
  std::function<void(const dl_phdr_info& library, const std::string& path)> take;
};

int look_at(dl_phdr_info* library, std::size_t, void* data) {
  const auto& search = *static_cast<const Search*>(data);
  const std::string path = library->dlpi_name == nullptr ? "" : library->dlpi_name;
  const std::string name = path.substr(path.rfind('/') + 1);
  if (std::any_of(search.beginnings.begin(), search.beginnings.end(),
                  [&](std::string_view beginning) { return name.starts_with(beginning); }))
    search.take(*library, path);
  return 0;
}

void for_each_library(Search search) {
  dl_iterate_phdr(look_at, &search);
}

}  // namespace

std::vector<std::string> loaded_libraries(std::span<const std::string_view> beginnings) {
  std::vector<std::string> found;
  for_each_library({beginnings, [&](const dl_phdr_info& library, const std::string& path) {
                      const std::string id = build_id(library);
                      found.push_back(path.substr(path.rfind('/') + 1) + " " + (id.empty() ? sha256_of_file(path) : id));
                    }});
  std::sort(found.begin(), found.end());
  return found;
}

void give_code_back(std::span<const std::string_view> beginnings) {
  const auto page = std::uintptr_t(sysconf(_SC_PAGESIZE));
  for_each_library({beginnings, [&](const dl_phdr_info& library, const std::string&) {
                      for (int i = 0; i < library.dlpi_phnum; ++i) {
                        const ElfW(Phdr)& part = library.dlpi_phdr[i];
                        if (part.p_type != PT_LOAD || (part.p_flags & PF_W) != 0) continue;
                        const std::uintptr_t begin = (library.dlpi_addr + part.p_vaddr) / page * page;
                        const std::uintptr_t end = library.dlpi_addr + part.p_vaddr + part.p_memsz;
                        // Of pages that nobody may write: they are in the file as they were here.
                        madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
                      }
                    }});
}

}  // namespace chainreel
