"""Both clients against `clench serve`.   CLENCH=build/release/clench python3 clients/python/tests/client_test.py"""
import asyncio
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import clench.client as clench  # noqa: E402

COMMAND = os.environ.get("CLENCH", "build/release/clench")


class Served(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.token_file = self.folder.name + "/token"
        self.process = subprocess.Popen(
            [COMMAND, "-q", "serve", "worlds/barrett_mug.wld", "--port", "0", "--token-file", self.token_file],
            stdout=subprocess.PIPE, text=True)
        self.process.stdout.readline()
        self.url = self.process.stdout.readline().split()[-1]

    def tearDown(self):
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()
        self.folder.cleanup()

    def test_a_hand_closes_by_the_names_of_lua(self):
        with clench.connect(self.url) as c:
            hand = c.world.robot("barrett")
            before = c.world.hash()
            self.assertTrue(hand.autograsp()["moved"])
            self.assertNotEqual(c.world.hash(), before)
            c.session.undo()
            self.assertEqual(c.world.hash(), before)
            self.assertEqual(len(hand.dofs), 4)
            hand.dofs = [0.1, 0.2, 0.2, 0.2]
            self.assertAlmostEqual(hand.dofs[1], 0.2)
            self.assertEqual(hand.get("name", "dofs")["name"], "barrett")
            self.assertIn("xyz", hand.pose)
            mug = c.world.body("mug")
            mug.mass = 0.5
            self.assertAlmostEqual(mug.mass, 0.5)
            self.assertEqual(mug.distance(hand.link("chain0_link2")), c.body.distance("mug", "barrett/chain0_link2"))
            self.assertEqual(c.world.run(0.002)["applied"], True)
            self.assertAlmostEqual(c.world.time, 0.002)

    def test_errors_have_classes(self):
        with clench.connect(self.url) as c:
            hand = c.world.robot("barrett")
            with self.assertRaises(clench.InvalidParams):
                hand.autograsp(speeed=1)
            with self.assertRaises(clench.MethodNotFound) as caught:
                c.call("no.such")
            self.assertEqual(caught.exception.code, -32601)
            with self.assertRaises(clench.Failed) as caught:
                c.world.body("nobody").mass = 1
            self.assertEqual(caught.exception.kind, "input")
            with self.assertRaises(clench.Refused):
                c.world.save_as("x.wld")
            for wrong in (lambda: hand.autograsp(1, 2, 3), lambda: hand.autograsp(1, speed=1),
                          lambda: c.call("world.distance", a=object()), lambda: hand.set(dofs=[], pose={})):
                self.assertRaises(TypeError, wrong)
            self.assertEqual(c.call("describe", method="world.hash")["reads"], True)
            self.assertRaises(AttributeError, lambda: c.grasp.nothing)
            self.assertRaises(AttributeError, lambda: c.nothing)
            with self.assertRaises(AttributeError):
                hand.name = "other"
            self.assertEqual(hand.name, "barrett")
            c.close()
            self.assertRaises(clench.ConnectionLost, c.world.hash)
        with self.assertRaises(clench.Unauthorized):
            clench.connect(self.url[:-2])
        with self.assertRaises(clench.ConnectionLost):
            clench.connect(path=self.folder.name + "/nothing", token="x")
        for wrong in ({"url": "http://x"}, {"url": self.url, "port": 1}, {"path": "a", "port": 1}):
            self.assertRaises(ValueError, clench.connect, **wrong)

    def test_an_answer_that_comes_too_late_is_an_error_and_is_dropped(self):
        with clench.connect(self.url, timeout=30) as c:
            c._timeout = 0
            self.assertRaises(TimeoutError, c.world.hash)
            c._timeout = 30
            self.assertAlmostEqual(c.world.time, 0)

    def test_a_server_that_ends_is_an_error(self):
        c = clench.connect(self.url)
        self.process.terminate()
        self.process.wait()
        self.assertRaises(clench.ConnectionLost, c.world.hash)
        c.close()

    def test_events_and_jobs(self):
        with clench.connect(self.url) as c:
            c.subscribe("changed")
            c.world.robot("barrett").autograsp()
            method, params = c.next_notification(10)
            self.assertEqual((method, params["event"]), ("event", "changed"))
            self.assertRaises(TimeoutError, c.next_notification, 0)
            job = c.plan("sample", hand="barrett", object="mug", candidates=20, count=1, threads=1)
            self.assertIn("grasps", job.result(60))

    def test_the_token_is_found_where_the_server_keeps_it(self):
        port = int(self.url.split(":")[2].split("/")[0])
        os.environ["XDG_RUNTIME_DIR"] = self.folder.name
        os.rename(self.token_file, f"{self.folder.name}/clench-{port}.token")
        with clench.connect(port=port) as c:
            self.assertTrue(c.version)

    def test_the_same_with_asyncio(self):
        async def run():
            async with await clench.connect_async(self.url) as c:
                hand = c.world.robot("barrett")
                dofs, mass, state = await asyncio.gather(hand.dofs, c.world.body("mug").mass, c.world.state())
                self.assertEqual((len(dofs), mass > 0, state["time"]), (4, True, 0))
                await c.subscribe("changed")
                self.assertTrue((await hand.autograsp())["moved"])
                self.assertEqual((await c.next_notification())[1]["event"], "changed")
                await hand.set(dofs=[0.1, 0.2, 0.2, 0.2])
                self.assertAlmostEqual((await hand.dofs)[1], 0.2)
                with self.assertRaises(AttributeError):
                    hand.dofs = [0, 0, 0, 0]
                with self.assertRaises(clench.InvalidParams):
                    await c.grasp.autograsp(speeed=1)
                job = await c.plan("sample", hand="barrett", object="mug", candidates=20, count=1, threads=1)
                self.assertIn("grasps", await job.result())
                self.process.terminate()
                self.process.wait()
                with self.assertRaises(clench.ConnectionLost):
                    while True:
                        await c.world.hash()
                with self.assertRaises(clench.ConnectionLost):
                    while True:
                        await c.next_notification()
            with self.assertRaises(clench.ConnectionLost):
                await clench.connect_async(self.url)

        asyncio.run(run())


if __name__ == "__main__":
    unittest.main()
