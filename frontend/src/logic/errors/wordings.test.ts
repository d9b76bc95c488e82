import { describe, expect, it } from "vitest";
import type { ErrorGroup } from "../../wire/types";
import { inLanguage } from "./wordings";

const ja = (name: string, description = "") => [{ language: "ja", name, description }];

const groups = [
  {
    name: "Fatal",
    wordings: ja("運転停止異常"),
    groups: [],
    errors: [
      {
        id: "memory-error",
        name: "Memory error",
        description: "A fault.",
        wordings: ja("メモリ異常", "異常です。"),
        details: [
          {
            name: "part",
            description: "Part",
            wordings: ja("", "異常箇所"),
            choices: [{ id: "table", description: "I/O table", address: "A403.05", wordings: ja("", "I/Oテーブル") }],
          },
        ],
      },
      { id: "plain", name: "Plain", description: "No other words.", details: [] },
    ],
  },
] as unknown as ErrorGroup[];

describe("a catalogue in a language", () => {
  it("has its names, descriptions, details and choices, and keeps the keys of details", () => {
    const [group] = inLanguage(groups, "ja");
    expect(group?.name).toBe("運転停止異常");
    const error = group?.errors[0];
    expect(error).toMatchObject({ name: "メモリ異常", description: "異常です。" });
    expect(error?.details[0]).toMatchObject({ name: "part", description: "異常箇所" });
    expect(error?.details[0]?.choices?.[0]).toMatchObject({ id: "table", description: "I/Oテーブル" });
  });

  it("can also be searched by the other name, and is unchanged without a wording", () => {
    const [group] = inLanguage(groups, "ja");
    expect(group?.errors[0]?.wordings?.map((wording) => wording.name)).toContain("Memory error");
    expect(group?.errors[1]).toMatchObject({ name: "Plain", description: "No other words." });
    expect(inLanguage(groups, "en")[0]).toMatchObject({ name: "Fatal" });
  });
});
