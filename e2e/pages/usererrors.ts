import { expect, type Locator, type Page } from '@playwright/test';

/** The page of the errors that the project defines itself. */
export class UserErrors {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane=usererrors]');
  }

  get list(): Locator {
    return this.pane.getByRole('listbox', { name: 'User-defined errors' });
  }

  error(name: string): Locator {
    return this.list.getByRole('option').filter({ hasText: name });
  }

  field(name: string): Locator {
    return this.pane.getByRole('textbox', { name, exact: true });
  }

  /** The problem of a field, as shown below it. */
  wrong(text: string | RegExp): Locator {
    return this.pane.locator('form .hint.bad').filter({ hasText: text });
  }

  button(name: string): Locator {
    return this.pane.getByRole('button', { name, exact: true });
  }

  /** Opens the page from the explorer, where it is below the model. */
  async open(): Promise<void> {
    const tree = this.page.getByRole('tree', { name: 'Explorer' });
    const row = tree.getByRole('treeitem', { name: 'User-defined errors', exact: true });
    if (!(await row.isVisible())) {
      await tree.getByRole('treeitem', { name: 'Model', exact: true }).focus();
      await this.page.keyboard.press('ArrowRight');
    }
    await row.dblclick();
    await expect(this.pane).toBeVisible();
  }

  async save(): Promise<void> {
    await this.button('Save').click();
    await expect(this.pane.getByText(/^Saved as version/)).toBeVisible();
  }

  async import(name: string, text: string): Promise<Locator> {
    await this.button('Import').click();
    const dialog = this.page.getByRole('dialog', { name: 'Import errors' });
    await dialog.getByLabel('File (XML)').setInputFiles({ name, mimeType: 'text/xml', buffer: Buffer.from(text) });
    await dialog.getByRole('button', { name: 'Import', exact: true }).click();
    return dialog;
  }
}
