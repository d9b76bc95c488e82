import { type Download, expect, type Locator, type Page } from '@playwright/test';

/** The error history, and the export and import of test records. */
export class History {
  constructor(private readonly page: Page) {}

  private get pane(): Locator {
    return this.page.locator('[data-pane=history]');
  }

  /** The page of an imported record. */
  get record(): Locator {
    return this.page.locator('[data-pane=record]');
  }

  get alert(): Locator {
    return this.pane.getByRole('alert');
  }

  rows(of: 'Error history' | 'Errors of the imported record' = 'Error history'): Locator {
    return this.page.getByRole('table', { name: of }).locator('tbody').getByRole('row');
  }

  async filter(name: 'State' | 'Severity' | 'Reaction', choice: string): Promise<void> {
    await this.pane.getByRole('button', { name: new RegExp(`^${name}: `) }).click();
    await this.page.getByRole('menuitemradio', { name: choice, exact: true }).click();
  }

  async search(text: string): Promise<void> {
    await this.pane.getByRole('searchbox').fill(text);
  }

  async sortBy(column: string): Promise<void> {
    await this.pane.getByRole('columnheader', { name: column }).getByRole('button').click();
  }

  async showVersion(version: RegExp): Promise<void> {
    await this.pane.getByRole('button', { name: /^History of: / }).click();
    await this.page.getByRole('menuitemradio', { name: version }).click();
  }

  /** Saves the test record as a file. */
  async save(item: 'Save as XML' | 'Save as CSV'): Promise<Download> {
    const [download] = await Promise.all([this.page.waitForEvent('download'), this.chooseInMenu(item)]);
    return download;
  }

  /** The document in a new tab. */
  async print(): Promise<Page> {
    const [tab] = await Promise.all([this.page.waitForEvent('popup'), this.chooseInMenu(/^Printable test record/)]);
    await tab.waitForLoadState();
    return tab;
  }

  async importFile(file: string | { name: string; mimeType: string; buffer: Buffer }): Promise<void> {
    const [chooser] = await Promise.all([
      this.page.waitForEvent('filechooser'),
      this.chooseInMenu(/^Import a test record/),
    ]);
    await chooser.setFiles(file);
  }

  private async chooseInMenu(item: string | RegExp): Promise<void> {
    await this.pane.getByRole('button', { name: 'Test record' }).click();
    const found = this.page.getByRole('menuitem', { name: item });
    await expect(found).toBeEnabled();
    await found.click();
  }
}
