#include "text_file.h"

// zlib: .mtx.gz; gzread takes plain files as they are
#include <zlib.h>

#include <fstream>
#include <memory>
#include <stdexcept>

namespace cli {

std::string read_text(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) { return std::runtime_error(path.string() + ": " + what); };
  if (!std::filesystem::is_regular_file(path)) throw fail("no such file");
  struct Close {
    void operator()(gzFile file) const { gzclose(file); }
  };
  const std::unique_ptr<gzFile_s, Close> file(gzopen(path.c_str(), "rb"));
  if (!file) throw fail("cannot be opened");
  std::string text;
  constexpr std::size_t chunk = 1 << 16;
  for (;;) {
    const std::size_t size = text.size();
    text.resize(size + chunk);
    const int got = gzread(file.get(), text.data() + size, chunk);
    text.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
    if (got > 0) continue;
    int code = Z_OK;  // a compressed file that ends too early reads as if it were whole, but leaves Z_BUF_ERROR
    gzerror(file.get(), &code);
    if (got < 0 || code != Z_OK) throw fail("damaged: it cannot be unpacked");
    return text;
  }
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace cli
