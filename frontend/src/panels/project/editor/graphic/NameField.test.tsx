import { render, screen, waitFor } from "@testing-library/react";
import userEvent from "@testing-library/user-event";
import { expect, test } from "vitest";
import { entered } from "../../../../store/project/entering";
import { NameField } from "./NameField";

const NAMING = { offers: "bool", taken: () => null } as const;

function openField(accepted: boolean, moves = false, value = "start") {
  const done: string[] = [];
  render(
    <>
      <NameField
        naming={{ ...NAMING, value }}
        spot={{ x: 0, y: 0, width: 100 }}
        label="name"
        names={() => Promise.resolve([])}
        onTake={(text) => {
          done.push(`take ${text}`);
          if (moves) screen.getByRole("button", { name: "Build" }).focus();
          return Promise.resolve(accepted);
        }}
        onLeave={() => {
          done.push("leave");
          if (moves) screen.getByRole("button", { name: "Build" }).focus();
        }}
      />
      <button type="button">Build</button>
    </>,
  );
  return { user: userEvent.setup(), done, field: screen.getByRole("combobox", { name: "name" }) };
}

test("what is typed is taken when the field is left by a click, and whoever builds waits for it", async () => {
  const { user, done, field } = openField(true);
  await user.clear(field);
  await user.type(field, "stop");
  await user.click(screen.getByRole("button", { name: "Build" }));
  await expect(entered()).resolves.toBe(true);
  expect(done).toEqual(["take stop"]);
});

test("what is refused keeps the build back once, and is given up at the next click", async () => {
  const { user, done, field } = openField(false);
  await user.clear(field);
  await user.type(field, "2 x");
  await user.click(screen.getByRole("button", { name: "Build" }));
  await expect(entered()).resolves.toBe(false);
  await waitFor(() => screen.getByRole("alert"));
  await user.click(field);
  await user.click(screen.getByRole("button", { name: "Build" }));
  expect(done).toEqual(["take 2 x", "leave"]);
  await expect(entered()).resolves.toBe(true);
});

test("a field in which nothing was typed is left as it was", async () => {
  const { user, done } = openField(true);
  await user.click(screen.getByRole("button", { name: "Build" }));
  expect(done).toEqual(["leave"]);
});

test("what Enter takes is taken once, although the drawing takes the focus meanwhile", async () => {
  const { user, done, field } = openField(true, true);
  await user.clear(field);
  await user.type(field, "stop{Enter}");
  await expect(entered()).resolves.toBe(true);
  expect(done).toEqual(["take stop"]);
});

test("Escape takes nothing, although the drawing takes the focus then", async () => {
  const { user, done, field } = openField(true, true);
  await user.clear(field);
  await user.type(field, "zzz{Escape}");
  await expect(entered()).resolves.toBe(true);
  expect(done).toEqual(["leave"]);
});

test.each([
  ["/stop", "/full"],
  ["R lamp", "R full"],
])("Ctrl+A and a new name leave %s what it is", async (value, becomes) => {
  const { user, done, field } = openField(true, false, value);
  await user.keyboard("{Control>}a{/Control}full{Enter}");
  await expect(entered()).resolves.toBe(true);
  expect(done).toEqual([`take ${becomes}`]);
  expect(field).toBeDefined();
});
