import { readFile } from 'node:fs/promises';
import { expect, type Locator, type Page } from '@playwright/test';
import { toFront } from './tabs';

/** The verification: the program executed twice, A beside A'. */
export class Verify {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane="verify"]');
  }

  async show(): Promise<void> {
    await toFront(this.page.getByRole('tab', { name: 'Verification', exact: true }));
    await expect(this.pane).toBeVisible();
  }

  /** Gives the panel the whole dock. */
  async maximise(): Promise<void> {
    await this.pane.getByRole('button', { name: 'Maximise this panel' }).click();
  }

  get dialog(): Locator {
    return this.page.getByRole('dialog', { name: 'New verification' });
  }

  get table(): Locator {
    return this.page.getByRole('grid', { name: 'A beside A′' });
  }

  /** The visible rows. */
  get rows(): Locator {
    return this.table.locator('[data-scan]');
  }

  row(scan: number): Locator {
    return this.table.locator(`[data-scan="${scan}"]`);
  }

  cell(scan: number, column: string): Locator {
    return this.row(scan).locator(`[data-cell="${column}"]`);
  }

  /** Verifying, Waiting, Done, Stopped ... */
  get state(): Locator {
    return this.pane.locator('[data-state]');
  }

  async count(what: 'compared' | 'skipped' | 'differ'): Promise<number> {
    const text = await this.pane.getByTestId(`verify:${what}`).locator('b').innerText();
    return Number(text.replace(/\D/g, ''));
  }

  /** The details of the selected row. */
  get facts(): Locator {
    return this.pane.getByRole('region', { name: 'What differs' });
  }

  get source(): Locator {
    return this.pane.getByRole('list', { name: 'Lines of the range' });
  }

  async press(name: string): Promise<void> {
    await this.pane.getByRole('button', { name, exact: true }).click();
  }

  async choose(group: 'Monitor runs on' | 'Pace', value: string): Promise<void> {
    const radio = this.pane.getByRole('radiogroup', { name: group }).getByRole('radio', { name: value });
    await radio.click();
    await expect(radio).toHaveAttribute('aria-checked', 'true');
  }

  /** Types into an input of a row, and enters it. */
  async set(scan: number, column: string, value: string): Promise<void> {
    await this.cell(scan, column).dblclick();
    const box = this.table.getByRole('textbox');
    await box.fill(value);
    await box.press('Enter');
  }

  async export(item: string): Promise<string> {
    await this.press('Export');
    const [download] = await Promise.all([
      this.page.waitForEvent('download'),
      this.page.getByRole('menu', { name: 'Export' }).getByText(item).click(),
    ]);
    return readFile(await download.path(), 'utf8');
  }
}
