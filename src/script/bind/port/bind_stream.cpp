// clench.open_serial, clench.open_pty, ...: streams of bytes and acceptors of clients, for
// stdlib/port.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "clench/base/file.h"
#include "clench/io/text/confine.h"
#include "clench/port/pty.h"
#include "clench/port/serial.h"
#include "clench/port/socket.h"
#include "clench/port/stream.h"
#include "clench/script/bind/output.h"
#include "clench/script/bind/port/natives.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/table.h"

namespace clench {

namespace {

using StreamPtr = std::shared_ptr<Stream>;
using AcceptorPtr = std::shared_ptr<Acceptor>;

Stream& stream_of(lua_State* L) { return *self<StreamPtr>(L); }

// stream:fill(): reads available bytes.   returns  their number
int fill(lua_State* L) { return push(L, static_cast<lua_Integer>(stream_of(L).fill())); }

// stream:size(): number of bytes read and not yet taken
int size(lua_State* L) { return push(L, static_cast<lua_Integer>(stream_of(L).received().size())); }

// stream:take(count)
int take(lua_State* L) {
  const int64_t count = check_integer(L, 2, "count");
  return push(
      L, std::string_view(stream_of(L).take(static_cast<size_t>(std::max<int64_t>(count, 0)))));
}

// stream:tail(count): the last bytes read, which are not taken
int tail(lua_State* L) {
  const std::string_view bytes = stream_of(L).received();
  const auto count = static_cast<size_t>(std::max<int64_t>(check_integer(L, 2, "count"), 0));
  return push(L, bytes.substr(bytes.size() - std::min(count, bytes.size())));
}

// stream:find(delimiter): number of bytes before the first delimiter; nil if there is none yet
int find(lua_State* L) {
  const size_t at = stream_of(L).find(string_at(L, 2));
  return at == std::string_view::npos ? push_nil(L) : push(L, static_cast<lua_Integer>(at));
}

// stream:write(bytes, from): sends the bytes after the first `from`.   returns  the number sent
int write(lua_State* L) {
  const std::string_view bytes = string_at(L, 2);
  const auto from = static_cast<size_t>(std::max<int64_t>(check_integer(L, 3, "from"), 0));
  const size_t sent = stream_of(L).write(bytes.substr(std::min(from, bytes.size())));
  return push(L, static_cast<lua_Integer>(sent));
}

int push_end(lua_State* L, Stream::End end) {
  switch (end) {
    case Stream::End::none:
      return push_nil(L);
    case Stream::End::closed:
      return push(L, "closed");
    case Stream::End::unplugged:
      break;
  }
  return push(L, "unplugged");
}

// stream:ending(), stream:write_ending(): reason why the direction has ended: nil, "closed" or
// "unplugged"
int ending(lua_State* L) { return push_end(L, stream_of(L).end()); }
int write_ending(lua_State* L) { return push_end(L, stream_of(L).write_end()); }

// stream:connect_error(): reason why a connection has failed; nil if it has not
int connect_error(lua_State* L) {
  const int error = stream_of(L).connect_error();
  return error == 0 ? push_nil(L) : push(L, system_reason(error));
}

int stream_name(lua_State* L) { return push(L, stream_of(L).name()); }
int stream_descriptor(lua_State* L) { return push(L, stream_of(L).descriptor()); }
int write_descriptor(lua_State* L) { return push(L, stream_of(L).write_descriptor()); }
int close_stream(lua_State* L) {
  stream_of(L).close();
  return 0;
}

const Entry stream_methods[] = {
    {"fill", guarded<fill>, ""},
    {"size", guarded<size>, ""},
    {"take", guarded<take>, "\n@param count integer"},
    {"tail", guarded<tail>, "\n@param count integer"},
    {"find", guarded<find>, "\n@param delimiter string"},
    {"write", guarded<write>, "\n@param bytes string\n@param from integer"},
    {"ending", guarded<ending>, ""},
    {"write_ending", guarded<write_ending>, ""},
    {"connect_error", guarded<connect_error>, ""},
    {"name", guarded<stream_name>, ""},
    {"descriptor", guarded<stream_descriptor>, ""},
    {"write_descriptor", guarded<write_descriptor>, ""},
    {"close", guarded<close_stream>, ""}};
const Class stream_class{
    .name = "stream", .variable = "stream", .doc = "", .methods = stream_methods};

}  // namespace

template <>
inline constexpr const Class* script_class<StreamPtr> = &stream_class;

namespace {

int push_stream(lua_State* L, Stream stream) {
  return push_object(L, std::make_shared<Stream>(std::move(stream)));
}

// acceptor:accept(): the stream of the next client; nil if none waits
int accept(lua_State* L) {
  std::optional<Stream> client = self<AcceptorPtr>(L)->accept();
  return client ? push_stream(L, std::move(*client)) : push_nil(L);
}

int acceptor_name(lua_State* L) { return push(L, self<AcceptorPtr>(L)->name()); }
int acceptor_port(lua_State* L) { return push(L, self<AcceptorPtr>(L)->port()); }
int acceptor_descriptor(lua_State* L) { return push(L, self<AcceptorPtr>(L)->descriptor()); }
int close_acceptor(lua_State* L) {
  self<AcceptorPtr>(L)->close();
  return 0;
}

const Entry acceptor_methods[] = {{"accept", guarded<accept>, ""},
                                  {"name", guarded<acceptor_name>, ""},
                                  {"port", guarded<acceptor_port>, ""},
                                  {"descriptor", guarded<acceptor_descriptor>, ""},
                                  {"close", guarded<close_acceptor>, ""}};
const Class acceptor_class{
    .name = "acceptor", .variable = "acceptor", .doc = "", .methods = acceptor_methods};

}  // namespace

template <>
inline constexpr const Class* script_class<AcceptorPtr> = &acceptor_class;

// The path of a device or socket. It may be anywhere, but must not leave the confined folder through
// a link inside it.
static std::string check_endpoint(lua_State* L, const std::string& path) {
  const std::string confine = get_setting(L, Setting::confine);
  if (leads_out(path, confine))
    fail(ErrorKind::file,
         "{}: a link leads out of {}, to which reading is confined; nothing is opened", path,
         confine);
  return path;
}

// open_serial(options)
int open_serial_stream(lua_State* L) {
  Table t(L, 1, "clench.port.serial");
  SerialOptions options{.path = check_endpoint(L, t.string("path"))};
  options.baud = t.integer("baud", options.baud);
  options.data_bits = t.integer("data_bits", options.data_bits);
  options.stop_bits = t.integer("stop_bits", options.stop_bits);
  options.parity =
      t.choice("parity", {{"none", Parity::none}, {"even", Parity::even}, {"odd", Parity::odd}},
               options.parity);
  options.flow = t.choice("flow",
                          {{"none", FlowControl::none},
                           {"hardware", FlowControl::hardware},
                           {"software", FlowControl::software}},
                          options.flow);
  t.done();
  return push_stream(L, open_serial(options));
}

// open_pty(): the stream of our side, and the path of the other one
int open_pty_stream(lua_State* L) {
  Pty pty = open_pty();
  push_stream(L, std::move(pty.stream));
  push(L, pty.path);
  return 2;
}

// open_pair(): two streams
int open_stream_pair(lua_State* L) {
  auto [a, b] = open_pair();
  push_stream(L, std::move(a));
  push_stream(L, std::move(b));
  return 2;
}

// open_stdio(): a stream of standard input and output, which stay open when it is closed
int open_stdio_stream(lua_State* L) {
  Descriptor input(fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3));
  Descriptor output(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3));
  if (!input.is_open() || !output.is_open())
    fail(ErrorKind::file, "standard input and output: {}", system_reason(errno));
  return push_stream(L, Stream(std::move(input), std::move(output), "standard input"));
}

// connect(address, port), connect(path): a stream that can be written once it is connected
int begin_stream(lua_State* L) {
  const std::string host = check_string(L, 1, "host");
  if (!given(L, 2)) return push_stream(L, begin_connect_unix(check_endpoint(L, host)));
  return push_stream(L, begin_connect({host}, check_int(L, 2, "port")));
}

// accept_at(address, port), accept_at(path)
int open_acceptor(lua_State* L) {
  const std::string host = check_string(L, 1, "host");
  return push_object(
      L, std::make_shared<Acceptor>(given(L, 2) ? Acceptor::tcp({host}, check_int(L, 2, "port"))
                                                : Acceptor::unix_socket(check_endpoint(L, host))));
}

// resolve(host, numeric): a list of numeric addresses
int resolve_host(lua_State* L) {
  const std::string host = check_string(L, 1, "host");
  return push_list_of(L, resolve(host, lua_toboolean(L, 2)),
                      [L](const HostAddress& one) { push(L, one.address); });
}

// save_secret(path, text): writes a file that only its owner may read
int save_secret(lua_State* L) {
  const std::string path = check_output(L, 1, "path");
  constexpr unsigned only_owner = 0600;
  Draft draft(path, string_at(L, 2), only_owner);
  draft.move_to(path);
  return 0;
}

// The path with its first link replaced by the link's target; the path itself if it has none. In a
// canonical path, only a dangling link remains, which writing would follow.
static std::filesystem::path through_link(const std::filesystem::path& path) {
  std::filesystem::path before, after;
  for (const auto& part : path) {
    const auto here = before / part;
    if (!after.empty()) {
      after /= part;
    } else if (std::filesystem::is_symlink(std::filesystem::symlink_status(here))) {
      after = before / std::filesystem::read_symlink(here);
    } else {
      before = here;
    }
  }
  return after.empty() ? path : after;
}

// canonical(path): the absolute path with all links replaced, also dangling ones
int canonical_path(lua_State* L) {
  const std::string path = check_string(L, 1, "path");
  constexpr int max_links = 40;
  std::filesystem::path next = path;
  for (int i = 0; i < max_links; ++i) {
    std::error_code code;
    const auto found = std::filesystem::weakly_canonical(next, code);
    if (code) fail(ErrorKind::file, "{}: {}", path, code.message());
    next = through_link(found);
    if (next == found) return push(L, found.string());
  }
  fail(ErrorKind::file, "{}: too many links", path);
}

}  // namespace clench
