import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { useBench } from "../store/plc/bench";
import { button, textOf } from "../testing/find";
import { openPage } from "../testing/page";
import { Status } from "../testing/routes";
import { t } from "../text";
import { App } from "./App";

test("once the server does not know the token any more, the page asks for it, and leads back to where one is", async () => {
  const { server } = await openPage();
  server.on("GET", "", () => new Status(401, { message: "not the token of this server", near: [] }));
  server.hangUp();
  await waitFor(() => expect(useBench.getState().phase).toBe("locked"));
  render(<App />);
  expect(textOf(screen.getByRole("heading", { level: 1 }))).toBe(t("shut.locked"));
  const token = screen.getByLabelText<HTMLInputElement>(t("shut.locked.token"));
  expect(token.form).toMatchObject({ method: "get" });
  expect(token.form?.getAttribute("action")).toBe(location.pathname);
  expect(token.name).toBe("token");
  expect(button(t("shut.locked.open"))).toHaveProperty("type", "submit");
});
