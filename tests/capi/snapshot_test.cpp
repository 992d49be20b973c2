#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "support.h"

using namespace capi;

namespace {

mlcp_status read(const Bytes& bytes, mlcp_problem** problem) {
  return mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, problem, nullptr, nullptr, nullptr, nullptr, 0);
}

/// A folder of its own, removed with all in it.
class Folder {
 public:
  Folder() {
    path_ = testing::TempDir() + "mlcp_snapshot_XXXXXX";
    EXPECT_NE(mkdtemp(path_.data()), nullptr);
  }
  ~Folder() {
    for (const std::string& file : files()) std::remove((path_ + "/" + file).c_str());
    rmdir(path_.c_str());
  }
  std::string file(const char* name) const { return path_ + "/" + name; }
  const char* path() const { return path_.c_str(); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    DIR* folder = opendir(path_.c_str());
    while (const dirent* entry = readdir(folder))
      if (entry->d_name[0] != '.') names.push_back(entry->d_name);
    closedir(folder);
    return names;
  }

 private:
  std::string path_;
};

Bytes contents(const std::string& path) {
  Bytes bytes;
  if (std::FILE* file = std::fopen(path.c_str(), "rb")) {
    for (int c; (c = std::fgetc(file)) != EOF;) bytes.push_back(static_cast<unsigned char>(c));
    std::fclose(file);
  }
  return bytes;
}

}  // namespace

TEST(Snapshot, ReadsBackAllThatWasWritten) {
  ProblemHandle problem = make_rich_problem();
  const Bytes bytes = snapshot(problem.get());
  mlcp_problem* raw = nullptr;
  ASSERT_EQ(read(bytes, &raw), MLCP_OK);
  ProblemHandle copy(raw);
  EXPECT_EQ(snapshot(copy.get()), bytes);
  EXPECT_EQ(mass_of(copy.get()).indices, mass_of(problem.get()).indices);
  EXPECT_EQ(mass_of(copy.get()).values, mass_of(problem.get()).values);
  EXPECT_EQ(jacobian_of(copy.get()).indices, jacobian_of(problem.get()).indices);
  EXPECT_EQ(jacobian_of(copy.get()).values, jacobian_of(problem.get()).values);
  EXPECT_EQ(compliance_of(copy.get()).values, compliance_of(problem.get()).values);
  EXPECT_EQ(mlcp_problem_body_count(copy.get()), 4);
}

TEST(Snapshot, OrderOfSparseMassesSurvives) {
  ProblemHandle problem = make_problem();
  const int32_t full_p[] = {0, 3, 5, 8}, full_r[] = {2, 0, 1, 1, 0, 0, 2, 1}, upper_p[] = {0, 1, 3}, upper_r[] = {0, 1, 0};
  const double full[] = {0.1, 3, 0, 4, 0, 0.1 + 1e-17, 5, 0}, upper[] = {1, 2, 0.5};
  ASSERT_EQ(mlcp_problem_body_add_sparse(problem.get(), 3, full_p, full_r, full, MLCP_FULL, nullptr), MLCP_OK)
      << mlcp_problem_error(problem.get());
  ASSERT_EQ(mlcp_problem_body_add_sparse(problem.get(), 2, upper_p, upper_r, upper, MLCP_UPPER, nullptr), MLCP_OK);
  mlcp_problem* raw = nullptr;
  ASSERT_EQ(read(snapshot(problem.get()), &raw), MLCP_OK);
  ProblemHandle copy(raw);
  EXPECT_EQ(mass_of(copy.get()).indices, mass_of(problem.get()).indices);
  for (mlcp_problem* p : {problem.get(), copy.get()}) {
    const double next[] = {7, 8, 0.25};
    ASSERT_EQ(mlcp_problem_body_set_mass(p, 1, next, 3), MLCP_OK);
  }
  EXPECT_EQ(snapshot(copy.get()), snapshot(problem.get()));
}

TEST(Snapshot, EmptyProblem) {
  ProblemHandle problem = make_problem();
  mlcp_problem* raw = nullptr;
  ASSERT_EQ(read(snapshot(problem.get()), &raw), MLCP_OK);
  ProblemHandle copy(raw);
  EXPECT_EQ(mlcp_problem_velocity_count(copy.get()), 0);
}

TEST(Snapshot, MasksAndSettings) {
  ProblemHandle problem = make_rich_problem();
  MaskHandle enabled = make_mask(4), start = make_mask(4, MLCP_ROW_AT_LOWER);
  const mlcp_row_state off = MLCP_ROW_DISABLED;
  ASSERT_EQ(mlcp_mask_set(enabled.get(), 1, 1, &off), MLCP_OK);
  ASSERT_EQ(mlcp_mask_take_keys(start.get(), problem.get()), MLCP_OK);
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.method = MLCP_METHOD_SIMPLEX;
  settings.tolerance = 1e-7;
  settings.max_work = 12345;
  SolverHandle solver = make_solver(&settings);
  const Bytes bytes = snapshot(problem.get(), solver.get(), enabled.get(), start.get());

  mlcp_problem* p = nullptr;
  mlcp_solver* s = nullptr;
  mlcp_mask *e = nullptr, *b = nullptr;
  ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, &p, &s, &e, &b, nullptr, 0), MLCP_OK);
  ProblemHandle problem_owner(p);
  SolverHandle solver_owner(s);
  MaskHandle enabled_owner(e), start_owner(b);
  EXPECT_EQ(mlcp_mask_equal(e, enabled.get()), 1);
  EXPECT_EQ(mlcp_mask_equal(b, start.get()), 1);
  mlcp_settings found;
  mlcp_settings_init(&found, sizeof found);
  ASSERT_EQ(mlcp_solver_get_settings(s, &found), MLCP_OK);
  EXPECT_EQ(found.method, MLCP_METHOD_SIMPLEX);
  EXPECT_EQ(found.tolerance, 1e-7);
  EXPECT_EQ(found.max_work, 12345);
  EXPECT_EQ(snapshot(p, s, e, b), bytes);
}

TEST(Snapshot, MasksThatWereNotSavedComeBackNull) {
  ProblemHandle problem = make_rich_problem();
  const Bytes bytes = snapshot(problem.get());
  MaskHandle other = make_mask(1);
  mlcp_mask *enabled = other.get(), *start = other.get();
  ASSERT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, nullptr, nullptr, &enabled, &start, nullptr, 0), MLCP_OK);
  EXPECT_EQ(enabled, nullptr);
  EXPECT_EQ(start, nullptr);
}

TEST(Snapshot, MaskOfAnotherSize) {
  ProblemHandle problem = make_rich_problem();
  MaskHandle mask = make_mask(3);
  size_t size = 0;
  EXPECT_EQ(mlcp_snapshot_write(problem.get(), nullptr, mask.get(), nullptr, 0, nullptr, &size, nullptr, 0), MLCP_ERROR_RANGE);
  EXPECT_EQ(mlcp_snapshot_write(problem.get(), nullptr, nullptr, mask.get(), 0, nullptr, &size, nullptr, 0), MLCP_ERROR_RANGE);
}

TEST(Snapshot, CapacityTooSmall) {
  ProblemHandle problem = make_rich_problem();
  const size_t needed = snapshot(problem.get()).size();
  Bytes buffer(needed, 0x77);
  size_t size = 0;
  EXPECT_EQ(mlcp_snapshot_write(problem.get(), nullptr, nullptr, nullptr, needed - 1, buffer.data(), &size, nullptr, 0),
            MLCP_ERROR_RANGE);
  EXPECT_EQ(size, needed);
  EXPECT_EQ(buffer, Bytes(needed, 0x77));
}

TEST(Snapshot, TruncatedAtEveryByte) {
  const Bytes bytes = snapshot(make_rich_problem().get());
  for (size_t size = 0; size < bytes.size(); ++size) {
    mlcp_problem* problem = nullptr;
    EXPECT_EQ(mlcp_snapshot_read(bytes.data(), size, nullptr, &problem, nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_FORMAT)
        << size;
    EXPECT_EQ(problem, nullptr);
  }
}

TEST(Snapshot, EveryBitFlipped) {
  const Bytes bytes = snapshot(make_rich_problem().get());
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes damaged = bytes;
    damaged[bit / 8] = static_cast<unsigned char>(damaged[bit / 8] ^ (1 << bit % 8));
    mlcp_problem* problem = nullptr;
    EXPECT_EQ(read(damaged, &problem), MLCP_ERROR_FORMAT) << bit;
    EXPECT_EQ(problem, nullptr);
  }
}

TEST(Snapshot, BytesBehindTheEnd) {
  Bytes bytes = snapshot(make_rich_problem().get());
  bytes.push_back(0);
  mlcp_problem* problem = nullptr;
  EXPECT_EQ(read(bytes, &problem), MLCP_ERROR_FORMAT);
}

TEST(Snapshot, SaveAndLoad) {
  Folder folder;
  const std::string path = folder.file("a.mlcp");
  ProblemHandle problem = make_rich_problem();
  ASSERT_EQ(mlcp_snapshot_save(path.c_str(), problem.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
  EXPECT_EQ(contents(path), snapshot(problem.get()));
  EXPECT_EQ(folder.files().size(), 1u);
  mlcp_problem* raw = nullptr;
  ASSERT_EQ(mlcp_snapshot_load(path.c_str(), nullptr, &raw, nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
  ProblemHandle copy(raw);
  EXPECT_EQ(snapshot(copy.get()), snapshot(problem.get()));
  // over the old one
  ASSERT_EQ(mlcp_problem_rows_clear(copy.get()), MLCP_OK);
  ASSERT_EQ(mlcp_snapshot_save(path.c_str(), copy.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_OK);
  EXPECT_EQ(contents(path), snapshot(copy.get()));
  EXPECT_EQ(folder.files().size(), 1u);
}

TEST(Snapshot, SaveThatFailsLeavesNothingBehind) {
  Folder folder;
  ProblemHandle problem = make_rich_problem();
  const std::string target = folder.file("taken");
  ASSERT_EQ(mkdir(target.c_str(), 0777), 0);
  EXPECT_EQ(mlcp_snapshot_save(target.c_str(), problem.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_IO);
  EXPECT_EQ(folder.files().size(), 1u);
  rmdir(target.c_str());
  EXPECT_EQ(mlcp_snapshot_save(folder.file("no/such/folder").c_str(), problem.get(), nullptr, nullptr, nullptr, nullptr, 0),
            MLCP_ERROR_IO);
  EXPECT_EQ(mlcp_snapshot_save("", problem.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_IO);
}

TEST(Snapshot, LoadOfWhatIsNoSnapshot) {
  Folder folder;
  mlcp_problem* problem = nullptr;
  const auto load = [&](const char* path) {
    return mlcp_snapshot_load(path, nullptr, &problem, nullptr, nullptr, nullptr, nullptr, 0);
  };
  EXPECT_EQ(load(folder.file("missing").c_str()), MLCP_ERROR_IO);
  EXPECT_EQ(load(folder.path()), MLCP_ERROR_IO);
  EXPECT_EQ(load("/dev/zero"), MLCP_ERROR_IO);
  const std::string text = folder.file("text");
  for (const char* words : {"", "MLCPSNAP", "a text of more than forty characters, which is no snapshot at all"}) {
    std::FILE* file = std::fopen(text.c_str(), "wb");
    std::fputs(words, file);
    std::fclose(file);
    EXPECT_EQ(load(text.c_str()), MLCP_ERROR_FORMAT);
  }
  EXPECT_EQ(problem, nullptr);
}

/// The text of a failed call on a buffer that is large enough.
template <class Call>
std::string message_of(mlcp_status status, Call call) {
  char message[512];
  std::memset(message, 'x', sizeof message);
  EXPECT_EQ(call(message, sizeof message), status);
  EXPECT_NE(std::memchr(message, 0, sizeof message), nullptr);
  return message;
}

TEST(Snapshot, MessagesOfFiles) {
  Folder folder;
  ProblemHandle problem = make_rich_problem();
  mlcp_problem* copy = nullptr;
  const auto load = [&](const std::string& path, mlcp_status status) {
    return message_of(status, [&](char* message, size_t size) {
      return mlcp_snapshot_load(path.c_str(), nullptr, &copy, nullptr, nullptr, nullptr, message, size);
    });
  };
  const auto save = [&](const std::string& path, mlcp_status status) {
    return message_of(status, [&](char* message, size_t size) {
      return mlcp_snapshot_save(path.c_str(), problem.get(), nullptr, nullptr, nullptr, message, size);
    });
  };
  const std::string path = folder.file("a.mlcp"), beyond = folder.file("none/a.mlcp");
  EXPECT_EQ(load(path, MLCP_ERROR_IO), "cannot open \"" + path + "\": " + std::strerror(ENOENT));
  EXPECT_EQ(save(beyond, MLCP_ERROR_IO), "cannot create a file beside \"" + beyond + "\": " + std::strerror(ENOENT));
  EXPECT_EQ(save(path, MLCP_OK), "");
  EXPECT_EQ(load(path, MLCP_OK), "");
  mlcp_problem_destroy(copy);
  ASSERT_EQ(truncate(path.c_str(), 60), 0);
  EXPECT_NE(load(path, MLCP_ERROR_FORMAT).find("\"" + path + "\": the snapshot has 20 bytes"), std::string::npos);
  ASSERT_EQ(truncate(path.c_str(), 20), 0);
  EXPECT_EQ(load(path, MLCP_ERROR_FORMAT), "\"" + path + "\": this is not a snapshot");
}

TEST(Snapshot, MessagesNameArguments) {
  ProblemHandle problem = make_rich_problem();
  MaskHandle mask = make_mask(3);
  unsigned char bytes[8] = {};
  size_t needed = 0;
  const auto write = [&](mlcp_status status, const mlcp_problem* p, const mlcp_mask* enabled, size_t capacity, size_t* size) {
    return message_of(status, [&](char* message, size_t room) {
      return mlcp_snapshot_write(p, nullptr, enabled, nullptr, capacity, bytes, size, message, room);
    });
  };
  EXPECT_EQ(write(MLCP_ERROR_NULL, nullptr, nullptr, 0, &needed), "problem is NULL");
  EXPECT_EQ(write(MLCP_ERROR_NULL, problem.get(), nullptr, 0, nullptr), "size is NULL");
  EXPECT_EQ(write(MLCP_ERROR_RANGE, problem.get(), mask.get(), 0, &needed), "rows of enabled = 3, but 4 are needed");
  const std::string small = write(MLCP_ERROR_RANGE, problem.get(), nullptr, 8, &needed);
  EXPECT_EQ(small, "capacity = 8, but " + std::to_string(needed) + " are needed");
  EXPECT_EQ(message_of(MLCP_ERROR_NULL, [&](char* message, size_t size) {
    return mlcp_snapshot_read(nullptr, 10, nullptr, nullptr, nullptr, nullptr, nullptr, message, size);
  }), "bytes is NULL");
}

TEST(Snapshot, MessagesAreCutAndTerminated) {
  const Bytes bytes(50, 'x');
  char message[9];
  for (size_t size = 0; size < sizeof message; ++size) {
    std::memset(message, '#', sizeof message);
    EXPECT_EQ(mlcp_snapshot_read(bytes.data(), bytes.size(), nullptr, nullptr, nullptr, nullptr, nullptr, message, size),
              MLCP_ERROR_FORMAT);
    EXPECT_EQ(message[size], '#');
    if (size > 0) {
      EXPECT_EQ(std::string(message), std::string("this is not a snapshot").substr(0, size - 1));
    }
  }
}

TEST(Snapshot, NullArguments) {
  ProblemHandle problem = make_rich_problem();
  size_t size = 0;
  mlcp_problem* out = nullptr;
  EXPECT_EQ(mlcp_snapshot_write(nullptr, nullptr, nullptr, nullptr, 0, nullptr, &size, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_write(problem.get(), nullptr, nullptr, nullptr, 0, nullptr, nullptr, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_save(nullptr, problem.get(), nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_save("x", nullptr, nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_load(nullptr, nullptr, &out, nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_read(nullptr, 10, nullptr, &out, nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_NULL);
  EXPECT_EQ(mlcp_snapshot_read(nullptr, 0, nullptr, &out, nullptr, nullptr, nullptr, nullptr, 0), MLCP_ERROR_FORMAT);
}
