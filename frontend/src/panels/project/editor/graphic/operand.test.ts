import { beforeEach, expect, test, vi } from "vitest";
import { Sheet } from "../../../../logic/graphic/sheet";
import { showWriter } from "../../../../store/past/writer";
import { currentText } from "../../../../store/plc/values";
import { showCrossReferences } from "../../../../store/project/cross";
import { forcedAt } from "../../../../store/watch/forces";
import { addToWatch, force, releaseForce } from "../../../../store/watch/watchlist";
import { eventually } from "../../../../testing/eventually";
import { operandAt, pressOperand } from "./operand";

// What the deeds do is tested where they are: here it counts which one a key means, and of which variable.
vi.mock("../../../../store/past/writer", () => ({ showWriter: vi.fn() }));
vi.mock("../../../../store/plc/values", () => ({ currentText: vi.fn(() => "FALSE") }));
vi.mock("../../../../store/project/cross", () => ({ showCrossReferences: vi.fn() }));
vi.mock("../../../../store/watch/forces", () => ({ forcedAt: vi.fn() }));
vi.mock("../../../../store/watch/watchlist", () => ({ addToWatch: vi.fn(), force: vi.fn(), releaseForce: vi.fn() }));
vi.mock("../watchAction", () => ({
  pathsOf: (_file: string, _line: number, names: string[]) => Promise.resolve(names.map((name) => `Main.gate.${name}`)),
}));

const [RUNG, NETWORK] = new Sheet().of(
  "RUNG\n    [go] [/stop] (run)\nEND_RUNG\nNETWORK\n    y := ADD(x, 3);\nEND_NETWORK\n",
  800,
);

beforeEach(() => {
  vi.clearAllMocks();
});

test("Ctrl+Alt+W watches the variable of the element, or of the pin", async () => {
  expect(pressOperand("Ctrl+Alt+w", "Gate.st", RUNG, [1])).toBe(true);
  await eventually(() => expect(addToWatch).toHaveBeenCalledWith(["Main.gate.stop"]));
  expect(pressOperand("Ctrl+Alt+W", "Gate.st", NETWORK, [0, 0])).toBe(true);
  await eventually(() => expect(addToWatch).toHaveBeenCalledWith(["Main.gate.x"]));
});

test("Ctrl+Alt+F forces a BOOL to its other value, and releases what is forced", async () => {
  pressOperand("Ctrl+Alt+F", "Gate.st", RUNG, [0]);
  await eventually(() => expect(force).toHaveBeenCalledWith("Main.gate.go", "Main.gate.go", "TRUE"));
  vi.mocked(currentText).mockReturnValueOnce("TRUE");
  pressOperand("Ctrl+Alt+F", "Gate.st", RUNG, [0]);
  await eventually(() => expect(force).toHaveBeenLastCalledWith("Main.gate.go", "Main.gate.go", "FALSE"));
  vi.mocked(forcedAt).mockReturnValueOnce({} as ReturnType<typeof forcedAt>);
  pressOperand("Ctrl+Alt+F", "Gate.st", RUNG, [2]);
  await eventually(() => expect(releaseForce).toHaveBeenCalledWith("Main.gate.run"));
  expect(force).toHaveBeenCalledTimes(2);
});

test("Ctrl+Alt+R shows who uses the variable, from where it is written; Shift+F12 who wrote it", async () => {
  pressOperand("Ctrl+Alt+R", "Gate.st", RUNG, [1]);
  const place = { file: "Gate.st", line: 2, column: 12 };
  await eventually(() => expect(showCrossReferences).toHaveBeenCalledWith(place, "Main.gate.stop"));
  pressOperand("Shift+F12", "Gate.st", RUNG, [2]);
  await eventually(() => expect(showWriter).toHaveBeenCalledWith("Main.gate.run"));
});

test("keys mean nothing where there is no variable, and other keys are none of these", async () => {
  expect(operandAt(NETWORK, [0, 1])).toBeNull(); // The literal 3.
  expect(pressOperand("Ctrl+Alt+W", "Gate.st", NETWORK, [0, 1])).toBe(true);
  expect(pressOperand("Ctrl+W", "Gate.st", RUNG, [0])).toBe(false);
  await Promise.resolve();
  expect(addToWatch).not.toHaveBeenCalled();
});
