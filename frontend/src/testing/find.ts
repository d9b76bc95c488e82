/** Finding and choosing as people do: by role and name. */
import { screen, within } from "@testing-library/react";
import type { UserEvent } from "@testing-library/user-event";

export const button = (name: string | RegExp, inside?: HTMLElement) =>
  (inside ? within(inside) : screen).getByRole("button", { name });

export const box = (name: string | RegExp, inside?: HTMLElement) =>
  (inside ? within(inside) : screen).getByRole<HTMLInputElement>("textbox", { name });

/** A text of the catalogue as the beginning of a name: a key or a fact may follow. */
export const begins = (text: string) => new RegExp(`^${text.replace(/[.+*?^$()|[\]\\{}]/g, "\\$&")}`);

/** Opens the menu of a button and chooses in it. */
export async function choose(user: UserEvent, opener: string | RegExp, item: string): Promise<void> {
  await user.click(button(opener));
  await pick(user, item);
}

/** The item of the menu that is open. */
export function menuItem(name: string): HTMLElement {
  const items = within(screen.getByRole("menu")).queryAllByRole("menuitem");
  const radios = within(screen.getByRole("menu")).queryAllByRole("menuitemradio");
  const found = [...items, ...radios].find((item) => begins(name).test(textOf(item)));
  if (!found) throw new Error(`the menu has no ${name}: ${[...items, ...radios].map(textOf).join(", ")}`);
  return found;
}

/** Chooses in the menu that is open. */
export const pick = (user: UserEvent, item: string) => user.click(menuItem(item));

/** What is there, in one string. */
export const textOf = (element: HTMLElement | null) => element?.textContent ?? "";
