import { describe, expect, it } from "vitest";
import type { ModelInfo, UserError } from "../../wire/types";
import {
  duplicate,
  exampleFor,
  freeId,
  generalProblems,
  groupText,
  idOf,
  newDetail,
  newError,
  problemsOf,
  readGroup,
  textOf,
  withControl,
  withText,
} from "./userErrors";

const model = {
  areas: [
    { name: "CIO", first: "CIO0", program: "write", tool: "write", retain: false },
    { name: "W", first: "W0", program: "write", tool: "write", retain: false },
  ],
  catalogue: [{ name: "Fatal", groups: [], errors: [{ id: "memory-error", code: "80F1" }, { code: "4F01" }] }],
} as unknown as ModelInfo;

const error = (changed: Partial<UserError>): UserError => ({ ...newError([], model), ...changed });

describe("ids", () => {
  it("are made from the name", () => {
    expect(idOf("Pump 2 overheated!")).toBe("pump-2-overheated");
    expect(idOf("2nd pump")).toBe("nd-pump");
    expect(idOf("ポンプ")).toBe("");
    expect(idOf(`${"a".repeat(63)} b`)).toMatch(/^a+$/);
  });
  it("get a number when the id is already used", () => {
    expect(freeId("pump", [])).toBe("pump");
    expect(freeId("pump", ["pump", "pump-2"])).toBe("pump-3");
    expect(freeId("pump-2", ["pump-2"])).toBe("pump-3");
  });
});

describe("texts", () => {
  it("keep English first, and omit empty languages", () => {
    const japanese = withText([], "ja", "name", "ポンプ");
    const both = withText(japanese, "en", "name", "Pump");
    expect(both.map(({ language }) => language)).toEqual(["en", "ja"]);
    expect(textOf(both, "ja", "name")).toBe("ポンプ");
    expect(withText(both, "ja", "name", "").map(({ language }) => language)).toEqual(["en"]);
  });
  it("of groups are written as paths", () => {
    expect(readGroup(" Pumps /Cooling/ ")).toEqual(["Pumps", "Cooling"]);
    expect(groupText(["Pumps", "Cooling"])).toBe("Pumps / Cooling");
  });
});

describe("new errors", () => {
  it("continue after the last one", () => {
    const first = error({ id: "a", group: ["Pumps"], code: "4101", priority: "1200" });
    const second = newError([first], model);
    expect([second.group, second.code, second.priority]).toEqual([["Pumps"], "4102", "1201"]);
    expect(newError([], model).code).toBe("");
  });
  it("are copied with a different id and code", () => {
    const first = error({ id: "a", code: "41FF", flag: "W10.00" });
    const copy = duplicate(first, [first], model);
    expect([copy.id, copy.code, copy.flag]).toEqual(["a-2", "4200", "W10.00"]);
  });
  it("begin with an example that the model accepts", () => {
    const example = exampleFor(model);
    expect([example.flag, example.code, example.id]).toEqual(["W10.00", "4F02", "pump-overheated"]);
    expect(exampleFor(null).flag).toBe("");
  });
});

describe("details", () => {
  it("change their control, and keep the addresses that they write", () => {
    const list = newDetail("List", []);
    list.addresses = list.addresses.map((address) => ({ ...address, id: "north", address: "W12.03", value: "3" }));
    const spin = withControl(list, "Spin");
    expect(spin.addresses).toHaveLength(1);
    expect(spin.addresses[0]).toMatchObject({ id: "", address: "W12.03", type: "Word", min: "0", max: "9", value: "" });
    const back = withControl(spin, "List");
    expect(back.addresses[0]).toMatchObject({ address: "W12.03", min: "", max: "" });
  });
});

describe("problems", () => {
  const problems = [
    { path: "errors.1.flag", code: "M003", message: "no such bit", line: 1, column: 1 },
    { path: "errors.1.flag", code: "M003", message: "and more", line: 1, column: 1 },
    { path: "errors.10.flag", code: "M003", message: "of another", line: 1, column: 1 },
    { path: "", code: "M001", message: "no XML", line: 1, column: 1 },
  ];
  it("belong to an error by their path", () => {
    expect([...problemsOf(problems, 1)]).toEqual([["flag", "no such bit"]]);
    expect(generalProblems(problems).map(({ message }) => message)).toEqual(["no XML"]);
  });
});
