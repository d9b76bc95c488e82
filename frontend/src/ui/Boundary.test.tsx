import { cleanup, render, within } from "@testing-library/react";
import { userEvent } from "@testing-library/user-event";
import { afterEach, expect, test, vi } from "vitest";
import { button, textOf } from "../testing/find";
import { t } from "../text";
import { Boundary } from "./Boundary";

afterEach(() => {
  cleanup();
  vi.restoreAllMocks();
});

test("a fault of one part is said in its place, leaves the rest, and can be tried again", async () => {
  vi.spyOn(console, "error").mockImplementation(() => undefined);
  let broken = true;
  const Part = () => {
    if (broken) throw new Error("no such scan");
    return <p role="timer">12</p>;
  };
  const { container } = render(
    <main>
      <h1>Scanbench</h1>
      <Boundary>
        <Part />
      </Boundary>
    </main>,
  );
  const page = within(container);
  expect(textOf(page.getByRole("heading"))).toBe("Scanbench");
  expect(textOf(page.getByRole("alert"))).toContain(t("boundary.fault", { message: "no such scan" }));
  broken = false;
  await userEvent.setup().click(button(t("boundary.again"), container));
  expect(textOf(page.getByRole("timer"))).toBe("12");
});
