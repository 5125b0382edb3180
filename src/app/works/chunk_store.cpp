#include "app/works/chunk_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/temporary_file.hpp"

namespace chainreel {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kHead = "chainreel chunk 1\n";
constexpr const char* kEnding = ".chunk";
constexpr std::size_t kHash = 64;       // hexadecimal digits
constexpr std::size_t kKeyInName = 16;  // of them

void put(std::string& bytes, std::int64_t number) {
  for (int k = 0; k < 8; ++k) bytes += char(std::uint64_t(number) >> (8 * k));
}

void put(std::string& bytes, const std::string& text) {
  put(bytes, std::int64_t(text.size()));
  bytes += text;
}

// Reads what put() wrote; what is not there reads as nothing.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  std::int64_t number() {
    std::uint64_t number = 0;
    const std::string_view taken = take(8);
    for (std::size_t k = taken.size(); k-- > 0;) number = number << 8 | std::uint8_t(taken[k]);
    return std::int64_t(number);
  }
  std::string text() { return std::string(take(std::size_t(number()))); }
  bool is_at_end() const { return left_.empty(); }

 private:
  std::string_view take(std::size_t count) {
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view left_;
};

std::string bytes_of(const FilmChunk& chunk) {
  std::string bytes;
  put(bytes, chunk.frames);
  for (const FilmPacket& packet : chunk.packets) {
    put(bytes, packet.pts);
    put(bytes, packet.is_key ? 1 : 0);
    put(bytes, packet.data);
    put(bytes, packet.opacity);
  }
  return bytes;
}

FilmChunk chunk_of(std::string_view text) {
  Bytes bytes(text);
  FilmChunk chunk;
  chunk.frames = int(bytes.number());
  while (!bytes.is_at_end()) {
    FilmPacket& packet = chunk.packets.emplace_back();
    packet.pts = bytes.number();
    packet.is_key = bytes.number() != 0;
    packet.data = bytes.text();
    packet.opacity = bytes.text();
  }
  return chunk;
}

fs::path folder_beside(const fs::path& film) {
  return film.parent_path() / ("." + film.filename().string() + ".resume");
}

// FIRST-BEHIND-KEY.chunk; what else lies there is somebody's.
bool is_chunk(const std::string& name) {
  const std::size_t one = name.find('-'), two = name.find('-', one + 1);
  const auto are_all = [](std::string_view text, const char* of) {
    return !text.empty() && text.find_first_not_of(of) == std::string_view::npos;
  };
  if (one == std::string::npos || two == std::string::npos || !name.ends_with(kEnding)) return false;
  const std::string_view text(name);
  return name.size() == two + 1 + kKeyInName + std::string_view(kEnding).size() && are_all(text.substr(0, one), "0123456789") &&
         are_all(text.substr(one + 1, two - one - 1), "0123456789") && are_all(text.substr(two + 1, kKeyInName), "0123456789abcdef");
}

template <class Wanted>
void remove_chunks(const std::string& folder, const Wanted& is_wanted) {
  std::error_code code, ignored;
  std::vector<fs::path> chunks;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (const std::string name = entry.path().filename().string(); is_chunk(name) && is_wanted(name)) chunks.push_back(entry.path());
  for (const fs::path& chunk : chunks) fs::remove(chunk, ignored);
}

}  // namespace

ChunkStore::ChunkStore(const std::string& film, std::string key)
    : film_(film), folder_(folder_beside(film).string()), key_(std::move(key)) {
  std::error_code code;
  fs::create_directories(folder_, code);
  lock_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock_ < 0)
    throw Error(ExitCode::file, std::string("its finished chunks cannot be kept in ") + folder_ + " (" + std::strerror(errno) + ")",
                {film_});
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    throw Error(ExitCode::file, "is being rendered by another process with --resume", {film_});
  }
  remove_leftovers(folder_);
  remove_chunks(folder_, [&](const std::string& name) { return name.find(key_.substr(0, kKeyInName)) == std::string::npos; });
}

ChunkStore::~ChunkStore() {
  if (lock_ >= 0) close(lock_);
}

std::string ChunkStore::path_of(int first, int behind) const {
  return (fs::path(folder_) / (std::to_string(first) + "-" + std::to_string(behind) + "-" + key_.substr(0, kKeyInName) + kEnding))
      .string();
}

std::optional<FilmChunk> ChunkStore::find(int first, int behind) const {
  std::ifstream stream(path_of(first, behind), std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  const std::string_view bytes = all;
  const std::size_t begin = kHead.size() + 2 * kHash;
  if (bytes.size() < begin || !bytes.starts_with(kHead) || bytes.substr(kHead.size(), kHash) != key_) return std::nullopt;
  const std::string_view content = bytes.substr(begin);
  if (sha256_of(content) != bytes.substr(kHead.size() + kHash, kHash)) return std::nullopt;  // a disk that lost a part
  FilmChunk chunk = chunk_of(content);
  if (chunk.frames != behind - first || int(chunk.packets.size()) != chunk.frames) return std::nullopt;
  return chunk;
}

void ChunkStore::keep(int first, int behind, const FilmChunk& chunk) const {
  const std::string content = bytes_of(chunk);
  TemporaryFile file(TemporaryFile::Kind::coming_file, folder_, kEnding, film_);
  std::ofstream stream(file.path(), std::ios::binary);
  stream << kHead << key_ << sha256_of(content) << content;
  stream.close();
  const std::string path = path_of(first, behind);
  if (!stream || std::rename(file.path().c_str(), path.c_str()) != 0)
    throw Error(ExitCode::file, "a finished chunk could not be kept: is the disk full?", {film_});
  file.let_go();
}

void ChunkStore::forget(const std::string& film) {
  const std::string folder = folder_beside(film).string();
  const int lock = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock < 0) return;
  if (flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
    remove_leftovers(folder);
    remove_chunks(folder, [](const std::string&) { return true; });
    std::error_code ignored;
    fs::remove(folder, ignored);  // unless somebody put something else there
  }
  close(lock);
}

}  // namespace chainreel
