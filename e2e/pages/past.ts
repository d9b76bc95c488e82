import { expect, type Locator, type Page } from '@playwright/test';

/** Queries about the past: what changed, who wrote it, two runs side by side, a replay, links to scans. */
export class Past {
  constructor(private readonly page: Page) {}

  /** The dialog that says who last wrote a variable. */
  get writer(): Locator {
    return this.page.getByRole('dialog', { name: /^Who last wrote / });
  }

  get changes(): Locator {
    return this.page.getByRole('dialog', { name: /^What changed between scan / });
  }

  /** A row of the table of changed variables. */
  changed(path: string): Locator {
    return this.changes.getByRole('row').filter({ has: this.page.getByRole('rowheader', { name: path, exact: true }) });
  }

  /** The page that compares two runs. */
  get comparison(): Locator {
    return this.page.getByRole('region', { name: /^Compare with / });
  }

  /** The banner that asks whether to follow a link. */
  get question(): Locator {
    return this.page.getByRole('region', { name: 'Link', exact: true });
  }

  /** Opens the page and compares this run with another one. */
  async compareWith(name: string): Promise<void> {
    await this.page.getByRole('button', { name: 'Project and instance' }).click();
    await this.page.getByRole('menuitem', { name: 'Compare runs…' }).click();
    const bar = this.page.getByRole('toolbar', { name: 'Compare runs' });
    await bar.getByRole('combobox').selectOption({ label: name });
    await bar.getByRole('button', { name: 'Compare', exact: true }).click();
    await expect(this.page.getByRole('region', { name: `Compare with ${name}` })).toBeVisible();
  }

  /** The dialog of a replay, for the error of a mark or of the history. */
  get replay(): Locator {
    return this.page.getByRole('dialog', { name: /^Replay with a change of / });
  }
}
