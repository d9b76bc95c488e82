import { expect, type Locator, type Page } from '@playwright/test';

/** The import of a controller log, and the kept verifications. */
export class TraceImport {
  constructor(private readonly page: Page) {}

  get dialog(): Locator {
    return this.page.getByRole('dialog', { name: 'Verify a controller log' });
  }

  async open(): Promise<void> {
    await this.fromProjectMenu('Import controller log…');
    await expect(this.dialog).toBeVisible();
  }

  private async fromProjectMenu(item: string): Promise<void> {
    await this.page.getByRole('button', { name: 'Project and instance' }).click();
    await this.page.getByRole('menuitem', { name: item }).click();
  }

  /** Chooses a file. */
  async choose(name: string, text: string): Promise<void> {
    await this.dialog
      .locator('input[type="file"]')
      .setInputFiles({ name, mimeType: 'text/csv', buffer: Buffer.from(text) });
  }

  column(name: string): Locator {
    return this.dialog.locator(`[data-column="${name}"]`);
  }

  role(column: string): Locator {
    return this.dialog.getByLabel(`Role of ${column}`, { exact: true });
  }

  variable(column: string): Locator {
    return this.dialog.getByRole('combobox', { name: `Variable for ${column}`, exact: true });
  }

  problem(text: string | RegExp): Locator {
    return this.dialog.getByRole('list', { name: 'Problems' }).getByRole('listitem').filter({ hasText: text });
  }

  get verdict(): Locator {
    return this.dialog.locator('footer').getByRole('status');
  }

  get start(): Locator {
    return this.dialog.getByRole('button', { name: 'Verify', exact: true });
  }

  /** Keeps the mapping in the project. */
  async saveAs(name: string): Promise<void> {
    await this.dialog.getByRole('button', { name: 'Save as…' }).click();
    const asking = this.page.getByRole('dialog', { name: 'Save as…' });
    await asking.getByRole('textbox', { name: 'Name of the mapping' }).fill(name);
    await asking.getByRole('button', { name: 'Save', exact: true }).click();
    await expect(asking).toBeHidden();
  }

  async load(name: string): Promise<void> {
    await this.dialog.getByRole('button', { name: 'Load…' }).click();
    await this.page.getByRole('menuitem', { name: new RegExp(`^${name}`) }).click();
  }

  // ---- kept verifications --------------------------------------------------------------------------------------------

  get records(): Locator {
    return this.page.getByRole('dialog', { name: 'Saved verifications' });
  }

  record(name: string): Locator {
    return this.records.getByRole('row').filter({ hasText: name });
  }

  async openRecords(): Promise<void> {
    await this.fromProjectMenu('Saved verifications…');
    await expect(this.records).toBeVisible();
  }
}
