#include "pipelines/results/netcdf_file.h"

#include <netcdf.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <mutex>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "pipelines/results/late_library.h"

namespace nurbeam {

namespace {

// netCDF, loaded when a file is first made or opened: it brings forty other libraries along, which take
// longer to load than a small case takes to check.
struct Netcdf : LateLibrary {
  Netcdf() : LateLibrary(NURBEAM_NETCDF_LIBRARY) {}

// NOLINTNEXTLINE(bugprone-macro-parentheses): it is the name of a member
#define NURBEAM_LATE(name) decltype(&::nc_##name) name = function<decltype(&::nc_##name)>("nc_" #name)
  NURBEAM_LATE(close);
  NURBEAM_LATE(create);
  NURBEAM_LATE(def_dim);
  NURBEAM_LATE(def_var);
  NURBEAM_LATE(def_var_chunking);
  NURBEAM_LATE(def_var_deflate);
  NURBEAM_LATE(enddef);
  NURBEAM_LATE(free_string);
  NURBEAM_LATE(get_att_text);
  NURBEAM_LATE(get_var_string);
  NURBEAM_LATE(get_vara);
  NURBEAM_LATE(get_vara_double);
  NURBEAM_LATE(get_vara_int);
  NURBEAM_LATE(inq_attlen);
  NURBEAM_LATE(inq_dimid);
  NURBEAM_LATE(inq_dimlen);
  NURBEAM_LATE(inq_dimname);
  NURBEAM_LATE(inq_nvars);
  NURBEAM_LATE(inq_unlimdims);
  NURBEAM_LATE(inq_var);
  NURBEAM_LATE(inq_vardimid);
  NURBEAM_LATE(inq_varid);
  NURBEAM_LATE(inq_varname);
  NURBEAM_LATE(inq_varndims);
  NURBEAM_LATE(open);
  NURBEAM_LATE(put_att_text);
  NURBEAM_LATE(put_var_string);
  NURBEAM_LATE(put_vara);
  NURBEAM_LATE(put_vara_double);
  NURBEAM_LATE(put_vara_int);
  NURBEAM_LATE(set_chunk_cache);
  NURBEAM_LATE(set_fill);
  NURBEAM_LATE(strerror);
  NURBEAM_LATE(sync);
#undef NURBEAM_LATE
};

const Netcdf& netcdf() {
  static const Netcdf library;
  return library;
}

// netCDF hides a full disk behind codes of its own.
std::string reason_of(int status) {
  const bool is_full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
  return is_full ? std::strerror(errno) : netcdf().strerror(status);
}

// Whether a call failed for want of memory. netCDF sets up libcurl for files of this machine too, which fails
// for nothing else there.
bool ran_short(int status) { return status == NC_ENOMEM || status == NC_ECURL || errno == ENOMEM; }

// Whether there is memory for a call of netCDF.
bool has_memory() {
  constexpr std::size_t for_a_call = 16 * 1024 * 1024;
  void* some = mmap(nullptr, for_a_call, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return some != MAP_FAILED && munmap(some, for_a_call) == 0;
}

// netCDF and HDF5 are not made for threads: one call at a time in the whole process.
[[nodiscard]] std::unique_lock<std::recursive_mutex> alone() {
  static std::recursive_mutex mutex;
  return std::unique_lock(mutex);
}

// Alone, and with memory: HDF5 ends the process, or crashes, where that runs short within it.
[[nodiscard]] std::unique_lock<std::recursive_mutex> one_at_a_time() {
  auto lock = alone();
  if (!has_memory()) throw std::bad_alloc();
  return lock;
}

// A file that cannot be closed stays open in HDF5, which writes to it again as the process ends, and crashes.
// What is registered later ends first: the process then ends without HDF5.
void end_without_hdf5() {
  static std::once_flag once;
  std::call_once(once, [] {
    on_exit(
        [](int exit_code, void*) {
          std::fflush(nullptr);
          _exit(exit_code);
        },
        nullptr);
  });
}

// Closes a file and tells whether it could. netCDF crashes where writing fails as it closes: what is to be
// written is written before, and a file that cannot be is left.
int closed(int id) {
  int status = netcdf().sync(id);
  if (status == NC_NOERR) status = netcdf().close(id);
  if (status != NC_NOERR) end_without_hdf5();
  return status;
}

// What a variable keeps in memory [B]: of one that is written or read in order, the end and what follows it.
// The library's own cache holds a hundred times that of every variable, until the file is closed.
constexpr std::size_t chunk_bytes = 128 * 1024, cache_bytes = 4 * chunk_bytes, cache_slots = 53;
constexpr float cache_preemption = 0.75F;
// Less of one variable is not compressed [B]: that takes longer than to write it, and spares two fifths.
constexpr std::size_t least_packed = 32 * 1024 * 1024;

void use_small_caches() { netcdf().set_chunk_cache(cache_bytes, cache_slots, cache_preemption); }

std::size_t product(const NetcdfFile::Sizes& count) {
  return std::accumulate(count.begin(), count.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace

static_assert(NetcdfFile::unlimited == NC_UNLIMITED);
const double NetcdfFile::fill = NC_FILL_DOUBLE;

NetcdfFile::NetcdfFile(std::filesystem::path file, int id, int status) : file_(std::move(file)), id_(id) {
  if (status == NC_NOERR) return;
  id_ = -1;
  if (ran_short(status)) throw std::bad_alloc();
  std::error_code none;
  const bool is_homeless = file_.has_parent_path() && !std::filesystem::exists(file_.parent_path(), none);
  throw std::runtime_error(file_.string() + ": " +
                           (is_homeless ? "its directory is not there" : reason_of(status)));
}

NetcdfFile NetcdfFile::create(const std::filesystem::path& file, bool packed) {
  const auto lock = one_at_a_time();
  int id = -1;
  errno = 0;
  use_small_caches();
  const int status = netcdf().create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
  NetcdfFile created(file, id, status);
  created.packed_ = packed;
  return created;
}

NetcdfFile NetcdfFile::create_classic(const std::filesystem::path& file) {
  const auto lock = one_at_a_time();
  int id = -1;
  errno = 0;
  const int status = netcdf().create(file.c_str(), NC_64BIT_DATA | NC_CLOBBER, &id);
  NetcdfFile created(file, id, status);
  created.is_defined_ = false;
  created.check(netcdf().set_fill(id, NC_NOFILL, nullptr), "fill");
  return created;
}

NetcdfFile NetcdfFile::open(const std::filesystem::path& file) {
  const auto lock = one_at_a_time();
  int id = -1;
  errno = 0;
  use_small_caches();
  const int status = netcdf().open(file.c_str(), NC_NOWRITE, &id);
  return {file, id, status};
}

NetcdfFile::NetcdfFile(NetcdfFile&& other) noexcept
    : file_(std::move(other.file_)),
      id_(std::exchange(other.id_, -1)),
      packed_(other.packed_),
      is_defined_(other.is_defined_),
      texts_(std::move(other.texts_)) {}

NetcdfFile::~NetcdfFile() {
  if (id_ < 0) return;
  const auto lock = alone();
  has_memory() ? void(closed(id_)) : end_without_hdf5();
}

void NetcdfFile::define_dimension(const std::string& name, std::size_t size) {
  const auto lock = one_at_a_time();
  int dimension;
  check(netcdf().def_dim(id_, name.c_str(), size, &dimension), name);
}

void NetcdfFile::define_plain(const std::string& name, Type type, const std::vector<std::string>& dimensions,
                              const std::string& unit, const std::string& long_name) {
  define_variable(name, type == Type::real ? NC_DOUBLE : NC_INT, dimensions);
  put_meaning(name, unit, long_name);
}

void NetcdfFile::define(const std::string& name, Type type, const std::vector<std::string>& dimensions,
                        const std::string& unit, const std::string& long_name, std::size_t rows) {
  const auto lock = one_at_a_time();
  const int variable = define_variable(name, type == Type::real ? NC_DOUBLE : NC_INT, dimensions);
  Sizes chunks{1};
  for (std::size_t i = 1; i < dimensions.size(); ++i) chunks.push_back(size(dimensions[i]));
  const std::size_t row_bytes = product(chunks) * (type == Type::real ? sizeof(double) : sizeof(int));
  chunks[0] = std::clamp<std::size_t>(rows, 1, std::max<std::size_t>(1, chunk_bytes / row_bytes));
  check(netcdf().def_var_chunking(id_, variable, NC_CHUNKED, chunks.data()), name);
  constexpr int shuffle = 1, deflate = 1, level = 1;
  if (packed_ && rows * row_bytes >= least_packed)
    check(netcdf().def_var_deflate(id_, variable, shuffle, deflate, level), name);
  put_meaning(name, unit, long_name);
}

void NetcdfFile::put_meaning(const std::string& name, const std::string& unit, const std::string& long_name) {
  put_attribute(name, "units", unit);
  put_attribute(name, "long_name", long_name);
}

void NetcdfFile::define_texts(const std::string& name, const std::string& dimension,
                              const std::string& long_name, const std::vector<std::string>& texts) {
  const auto lock = one_at_a_time();
  define_variable(name, NC_STRING, {dimension});
  put_attribute(name, "long_name", long_name);
  texts_.emplace_back(name, texts);
}

void NetcdfFile::begin_values() {
  if (!std::exchange(is_defined_, true)) check(netcdf().enddef(id_), "definitions");
  for (const auto& [name, texts] : std::exchange(texts_, {})) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    check(netcdf().put_var_string(id_, variable(name), pointers.data()), name);
  }
}

void NetcdfFile::put_attribute(const std::string& variable, const std::string& name,
                               const std::string& text) {
  const auto lock = one_at_a_time();
  const int owner = variable.empty() ? NC_GLOBAL : this->variable(variable);
  check(netcdf().put_att_text(id_, owner, name.c_str(), text.size(), text.c_str()), name);
}

std::string NetcdfFile::attribute(const std::string& variable, const std::string& name) const {
  const auto lock = one_at_a_time();
  const int owner = variable.empty() ? NC_GLOBAL : this->variable(variable);
  std::size_t length = 0;
  check(netcdf().inq_attlen(id_, owner, name.c_str(), &length), name);
  std::string text(length, '\0');
  check(netcdf().get_att_text(id_, owner, name.c_str(), text.data()), name);
  return text;
}

void NetcdfFile::put(const std::string& name, const Sizes& start, const Sizes& count, const double* values) {
  const auto lock = one_at_a_time();
  begin_values();
  check(netcdf().put_vara_double(id_, variable(name), start.data(), count.data(), values), name);
}

void NetcdfFile::put(const std::string& name, const Sizes& start, const Sizes& count, const int* values) {
  const auto lock = one_at_a_time();
  begin_values();
  check(netcdf().put_vara_int(id_, variable(name), start.data(), count.data(), values), name);
}

std::vector<int> NetcdfFile::unlimited_dimensions() const {
  int count = 0;
  check(netcdf().inq_unlimdims(id_, &count, nullptr), "dimensions");
  std::vector<int> dimensions(count);
  check(netcdf().inq_unlimdims(id_, &count, dimensions.data()), "dimensions");
  return dimensions;
}

void NetcdfFile::append(const NetcdfFile& from) {
  const auto lock = one_at_a_time();
  begin_values();
  for (const int along : from.unlimited_dimensions()) {
    char name[NC_MAX_NAME + 1];
    from.check(netcdf().inq_dimname(from.id_, along, name), "dimension");
    if (!has_dimension(name)) continue;
    const std::size_t rows = from.size(name), first = size(name);
    int variables = 0;
    from.check(netcdf().inq_nvars(from.id_, &variables), "variables");
    for (int variable = 0; variable < variables && rows > 0; ++variable) {
      int dimensions = 0;
      from.check(netcdf().inq_varndims(from.id_, variable, &dimensions), "variable");
      std::vector<int> over(dimensions);
      from.check(netcdf().inq_vardimid(from.id_, variable, over.data()), "variable");
      if (!over.empty() && over[0] == along) append_rows(from, variable, rows, first);
    }
  }
}

// Of a variable of another file, behind the first rows.
void NetcdfFile::append_rows(const NetcdfFile& from, int variable, std::size_t rows, std::size_t first) {
  char name[NC_MAX_NAME + 1];
  from.check(netcdf().inq_varname(from.id_, variable, name), "variable");
  if (!has_variable(name)) return;
  int dimensions = 0;
  nc_type type = NC_DOUBLE;
  check(netcdf().inq_var(id_, this->variable(name), nullptr, &type, &dimensions, nullptr, nullptr), name);
  std::vector<int> over(dimensions);
  check(netcdf().inq_vardimid(id_, this->variable(name), over.data()), name);
  Sizes start(dimensions, 0), count(dimensions, 1);
  for (int d = 1; d < dimensions; ++d) check(netcdf().inq_dimlen(id_, over[d], &count[d]), name);
  const std::size_t row_bytes = product(count) * (type == NC_INT ? sizeof(int) : sizeof(double));
  const std::size_t at_once = std::max<std::size_t>(1, chunk_bytes / row_bytes);
  std::vector<std::byte> values(std::min(at_once, rows) * row_bytes);
  for (std::size_t done = 0; done < rows; done += count[0]) {
    count[0] = std::min(at_once, rows - done);
    start[0] = done;
    from.check(netcdf().get_vara(from.id_, variable, start.data(), count.data(), values.data()), name);
    start[0] = first + done;
    check(netcdf().put_vara(id_, this->variable(name), start.data(), count.data(), values.data()), name);
  }
}

std::vector<double> NetcdfFile::doubles(const std::string& name, const Sizes& start,
                                        const Sizes& count) const {
  const auto lock = one_at_a_time();
  std::vector<double> values(product(count));
  check(netcdf().get_vara_double(id_, variable(name), start.data(), count.data(), values.data()), name);
  return values;
}

std::vector<int> NetcdfFile::integers(const std::string& name, const Sizes& start, const Sizes& count) const {
  const auto lock = one_at_a_time();
  std::vector<int> values(product(count));
  check(netcdf().get_vara_int(id_, variable(name), start.data(), count.data(), values.data()), name);
  return values;
}

std::vector<std::string> NetcdfFile::texts(const std::string& name) const {
  const auto lock = one_at_a_time();
  int dimension;
  check(netcdf().inq_vardimid(id_, variable(name), &dimension), name);
  std::size_t size = 0;
  check(netcdf().inq_dimlen(id_, dimension, &size), name);
  std::vector<char*> pointers(size, nullptr);
  check(netcdf().get_var_string(id_, variable(name), pointers.data()), name);
  std::vector<std::string> texts(pointers.begin(), pointers.end());
  netcdf().free_string(size, pointers.data());
  return texts;
}

bool NetcdfFile::has_dimension(const std::string& name) const {
  const auto lock = one_at_a_time();
  int dimension;
  return netcdf().inq_dimid(id_, name.c_str(), &dimension) == NC_NOERR;
}

bool NetcdfFile::has_variable(const std::string& name) const {
  const auto lock = one_at_a_time();
  int variable;
  return netcdf().inq_varid(id_, name.c_str(), &variable) == NC_NOERR;
}

std::size_t NetcdfFile::size(const std::string& dimension) const {
  const auto lock = one_at_a_time();
  std::size_t size = 0;
  check(netcdf().inq_dimlen(id_, this->dimension(dimension), &size), dimension);
  return size;
}

void NetcdfFile::close() {
  const auto lock = one_at_a_time();
  begin_values();
  check(closed(std::exchange(id_, -1)), "close");
}

void NetcdfFile::check(int status, const std::string& what) const {
  if (status == NC_NOERR) return;
  if (ran_short(status)) throw std::bad_alloc();
  throw std::runtime_error(file_.string() + ": " + what + ": " + reason_of(status));
}

int NetcdfFile::dimension(const std::string& name) const {
  int dimension = -1;
  check(netcdf().inq_dimid(id_, name.c_str(), &dimension), name);
  return dimension;
}

int NetcdfFile::variable(const std::string& name) const {
  int variable = -1;
  check(netcdf().inq_varid(id_, name.c_str(), &variable), name);
  return variable;
}

int NetcdfFile::define_variable(const std::string& name, int type,
                                const std::vector<std::string>& dimensions) {
  std::vector<int> ids;
  for (const std::string& each : dimensions) ids.push_back(dimension(each));
  int variable = -1;
  check(netcdf().def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable), name);
  return variable;
}

}  // namespace nurbeam
