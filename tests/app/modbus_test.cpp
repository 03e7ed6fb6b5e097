// Both sides of Modbus, each with libmodbus on the other end of the line.
#include <modbus/modbus.h>

#include <array>
#include <chrono>
#include <memory>
#include <thread>

#include "background.h"
#include "command.h"

using namespace clench::test;

namespace {

constexpr int slave = 9;
constexpr int requests = 0x03E8, status = 0x07D0;  // addresses of the gripper's registers

using Line = std::unique_ptr<modbus_t, decltype(&modbus_free)>;

Line open_line(const std::string& path) {
  Line line(modbus_new_rtu(path.c_str(), 115200, 'N', 8, 1), &modbus_free);
  REQUIRE(line);
  REQUIRE(modbus_set_slave(line.get(), slave) == 0);
  REQUIRE(modbus_connect(line.get()) == 0);
  return line;
}

// answers requests until the other side closes the line
void serve(modbus_t* line, modbus_mapping_t* registers) {
  std::array<uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> request{};
  int size = 0;
  while ((size = modbus_receive(line, request.data())) >= 0)
    if (size > 0) modbus_reply(line, request.data(), size, registers);
}

// status, fault and echo of the goal, position and current: each register has two of these bytes
std::array<uint16_t, 3> read_status(modbus_t* line) {
  std::array<uint16_t, 3> words{};
  CHECK(modbus_read_registers(line, status, 3, words.data()) == 3);
  return words;
}

// the status once one of its first byte's fields is no longer 0
std::array<uint16_t, 3> wait_for(modbus_t* line, int shift) {
  for (int i = 0; i < 1000; ++i) {
    const auto words = read_status(line);
    if (words[0] >> 8 >> shift & 3) return words;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  FAIL("the gripper does not react");
  return {};
}

}  // namespace

TEST_CASE("libmodbus as a slave understands drivers, for all counts of registers") {
  const Folder folder;
  const std::string script = folder.file("master.lua", R"(
local modbus = require "clench.devices.modbus"
local port = clench.port.pty()
print(port.path)
io.stdout:flush()
local master = {subject = "master", port = port, slave = 9, timeout = 1, attempts = 20}
for count = 1, 123 do
  local bytes = {}
  for i = 1, 2 * count do bytes[i] = string.char(37 * i + 11 * count & 0xFF) end
  modbus.write(master, 0x03E8, table.concat(bytes))
  assert(modbus.read(master, 0x03E8, count) == table.concat(bytes))
end
print(pcall(modbus.read, master, 0x100, 1))
print(pcall(modbus.write, master, 0x100, "ab"))
port:close()
)");
  Background driver("-q run " + script);
  const Line line = open_line(driver.line());
  const std::unique_ptr<modbus_mapping_t, decltype(&modbus_mapping_free)> registers(
      modbus_mapping_new_start_address(0, 0, 0, 0, requests, 123, 0, 0), &modbus_mapping_free);
  serve(line.get(), registers.get());
  const std::string output = driver.rest();
  CHECK(has(output, "master: the device rejects the request: reading registers (exception 2)"));
  CHECK(has(output, "master: the device rejects the request: writing registers (exception 2)"));
  for (int i = 0; i < 123; ++i) {
    const auto byte = [](int number) { return (37 * number + 11 * 123) & 0xFF; };
    CHECK(registers->tab_registers[i] == (byte(2 * i + 1) << 8 | byte(2 * i + 2)));
  }
}

TEST_CASE("libmodbus as a master commands the simulated gripper") {
  const Folder folder;
  const std::string script = folder.file("gripper.lua", R"(
local gripper = clench.devices.simulated.robotiq {object = 128}
print(gripper.path)
io.stdout:flush()
while true do clench.loop.sleep(1) end
)");
  const Background gripper("-q run " + script);
  const Line owner = open_line(gripper.line());
  modbus_t* line = owner.get();
  modbus_set_response_timeout(line, 5, 0);

  const auto command = [&](std::array<uint16_t, 3> words) {
    CHECK(modbus_write_registers(line, requests, 3, words.data()) == 3);
  };
  CHECK((read_status(line)[0] >> 8 & 0x31) == 0);
  command({0x0100, 0, 0});
  CHECK((wait_for(line, 4)[0] >> 8 & 0x31) == 0x31);
  command({0x0900, 0x00FF, 0x80FF});  // close, at half the speed
  const auto stopped = wait_for(line, 6);
  CHECK((stopped[0] >> 8 >> 6) == 2);  // by an object, while closing
  CHECK(stopped[1] == 0x00FF);
  CHECK(stopped[2] == 0x8000);
  uint16_t word = 0;
  CHECK(modbus_read_registers(line, status + 2, 1, &word) == 1);
  CHECK(word == stopped[2]);

  // refusals
  CHECK(modbus_read_registers(line, 0, 1, &word) == -1);
  CHECK(errno == EMBXILADD);
  CHECK(modbus_write_register(line, requests, 0) == -1);
  CHECK(errno == EMBXILFUN);
  // frames for other slaves have no answer
  modbus_set_slave(line, slave + 1);
  modbus_set_response_timeout(line, 0, 50000);
  CHECK(modbus_read_registers(line, status, 1, &word) == -1);
  CHECK(errno == ETIMEDOUT);
}
