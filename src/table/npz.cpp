#include "table/npz.hpp"

#include <minizip/zip.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/error.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory, as '<f8'");

// What minizip takes for a file: it goes back to complete the head of each entry.
struct MemoryFile {
  std::string bytes;
  std::size_t at = 0;
};

MemoryFile& file_of(void* stream) {
  return *static_cast<MemoryFile*>(stream);
}

voidpf open_memory(voidpf opaque, const void*, int) {
  return opaque;
}

uLong read_memory(voidpf, voidpf stream, void* buffer, uLong size) {
  MemoryFile& file = file_of(stream);
  const std::size_t count = std::min<std::size_t>(size, file.bytes.size() - file.at);
  std::memcpy(buffer, file.bytes.data() + file.at, count);
  file.at += count;
  return uLong(count);
}

uLong write_memory(voidpf, voidpf stream, const void* buffer, uLong size) {
  MemoryFile& file = file_of(stream);
  if (file.at + size > file.bytes.size()) file.bytes.resize(file.at + size);
  std::memcpy(file.bytes.data() + file.at, buffer, size);
  file.at += size;
  return size;
}

ZPOS64_T tell_memory(voidpf, voidpf stream) {
  return file_of(stream).at;
}

long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  MemoryFile& file = file_of(stream);
  const std::size_t base = origin == ZLIB_FILEFUNC_SEEK_CUR ? file.at : origin == ZLIB_FILEFUNC_SEEK_END ? file.bytes.size() : 0;
  if (base + offset > file.bytes.size()) return -1;
  file.at = base + std::size_t(offset);
  return 0;
}

int close_memory(voidpf, voidpf) {
  return 0;
}

class Archive {
 public:
  Archive() {
    zlib_filefunc64_def functions{open_memory, read_memory, write_memory, tell_memory, seek_memory, close_memory, close_memory, &file_};
    zip_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
    require(zip_ != nullptr);
  }
  ~Archive() {
    if (zip_ != nullptr) zipClose(zip_, nullptr);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // As it is: NumPy's own archives are not compressed either.
  void add(const std::string& name, std::string_view head, std::string_view data) {
    zip_fileinfo about{};
    about.tmz_date.tm_year = 1980;  // the first of the format's dates: the same bytes whenever they are written
    about.tmz_date.tm_mday = 1;
    const bool is_large = head.size() + data.size() > 0xFFFFFFFEU;
    require(zipOpenNewFileInZip64(zip_, name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr, 0, 0, is_large) == ZIP_OK);
    write(head);
    write(data);
    require(zipCloseFileInZip(zip_) == ZIP_OK);
  }

  std::string finish() {
    const int status = zipClose(zip_, nullptr);
    zip_ = nullptr;
    require(status == ZIP_OK);
    return std::move(file_.bytes);
  }

 private:
  void write(std::string_view bytes) {
    constexpr std::size_t kMost = std::size_t(1) << 30;  // the library counts a call's bytes in 32 bits
    for (std::size_t begin = 0; begin < bytes.size(); begin += kMost) {
      const std::string_view piece = bytes.substr(begin, kMost);
      require(zipWriteInFileInZip(zip_, piece.data(), unsigned(piece.size())) == ZIP_OK);
    }
  }
  static void require(bool is_good) {
    if (!is_good) throw Error(ExitCode::limit, "the table cannot be held by an .npz file: take .csv");
  }

  MemoryFile file_;
  zipFile zip_ = nullptr;
};

// The head of an .npy file, version 1.0: filled up so that the data begin at a multiple of 64 bytes.
std::string npy_head(const std::string& type, const std::vector<std::size_t>& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t n : shape) text += std::to_string(n) + ",";  // also Python's word for a tuple of one
  text += "), }";
  constexpr std::size_t kBefore = 10;  // bytes: magic, version, length
  while ((kBefore + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string head("\x93NUMPY\x01\x00", 8);
  head += char(text.size() & 0xFF);
  head += char(text.size() >> 8);
  return head + text;
}

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

// Texts as NumPy has them: of one length, UTF-32, filled up with zeros.
void add_texts(Archive& archive, const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::u32string> words;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    words.push_back(code_points(text));
    longest = std::max(longest, words.back().size());
  }
  std::u32string all;
  for (std::u32string& word : words) {
    word.resize(longest);
    all += word;
  }
  archive.add(name + ".npy", npy_head("<U" + std::to_string(longest), {words.size()}),
              {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(char32_t)});
}

}  // namespace

std::string npz_bytes(const DataTable& table) {
  Archive archive;
  std::vector<std::string> columns;
  for (const WordArray& array : table.words) {
    add_texts(archive, array.name, array.values);
    columns.push_back(array.name);
  }
  for (const DataArray& array : table.arrays) {
    std::vector<std::size_t> shape{table.rows};
    shape.insert(shape.end(), array.shape.begin(), array.shape.end());
    archive.add(array.name + ".npy", npy_head("<f8", shape), bytes_of(array.values));
    columns.insert(columns.end(), array.columns.begin(), array.columns.end());
  }
  add_texts(archive, "columns", columns);
  return archive.finish();
}

}  // namespace chainreel
