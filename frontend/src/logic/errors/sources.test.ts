import { expect, test } from "vitest";
import { t } from "../../text";
import { legendOf } from "./sources";

test("the keys that sources have are explained, each once and no others", () => {
  const found = legendOf([
    "flag SEED, LIBFINS, NPM; code K-H; a CJ1M has no inner board (LIBFINS, K-M)",
    "manual, p. 12",
  ]);
  expect(found.map(({ key }) => key)).toEqual(["K-H", "K-M", "SEED", "LIBFINS", "NPM"]);
  expect(found[0]?.meaning).toBe(t("source.K-H"));
  expect(legendOf(["manual, p. 12"])).toEqual([]);
});
