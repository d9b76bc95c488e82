import { expect, type Locator, type Page } from '@playwright/test';

/** The watch table: values as they are, and the place where they are changed. */
export class Watch {
  constructor(private readonly page: Page) {}

  get table(): Locator {
    return this.page.getByRole('treegrid', { name: 'Watch table' });
  }

  row(path: string): Locator {
    return this.table.getByRole('row').and(this.page.locator(`[data-path="${path}"]`));
  }

  value(path: string): Locator {
    return this.page.getByTestId(`current:${path}`);
  }

  entry(path: string): Locator {
    return this.page.getByRole('textbox', { name: `Change ${path}`, exact: true });
  }

  /** Why the last entry was not taken; it stands below its row. */
  get refusal(): Locator {
    return this.table.getByRole('alert');
  }

  async shows(path: string, value: string | RegExp): Promise<void> {
    await expect(this.value(path)).toHaveText(value);
  }

  async number(path: string): Promise<number> {
    return Number(await this.value(path).textContent());
  }

  async add(path: string): Promise<void> {
    const box = this.page.getByRole('combobox', { name: 'Add to watch' });
    await box.fill(path);
    await box.press('Enter');
    await expect(this.row(path)).toBeVisible();
  }

  async write(path: string, value: string): Promise<void> {
    await this.entry(path).fill(value);
    await this.entry(path).press('Enter');
  }

  /** Writes, and sees that it was taken: the entry is empty again. */
  async set(path: string, value: string): Promise<void> {
    await this.write(path, value);
    await expect(this.entry(path)).toHaveValue('');
  }

  async fromMenu(path: string, item: string): Promise<void> {
    await this.row(path).click({ button: 'right' });
    await this.page.getByRole('menuitem', { name: item, exact: true }).click();
  }

  /** The lock in front of a forced row. */
  releaseOf(path: string): Locator {
    return this.page.getByRole('button', { name: `Release force of ${path}`, exact: true });
  }

  /** Who wrote a value last, as the tooltip of its name says. */
  writtenBy(path: string, who: string): Locator {
    return this.row(path).getByTitle(`Written by ${who}`);
  }
}
